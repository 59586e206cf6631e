# Installs what is built, builds examples/ against it as a user would, and runs its stages:
#   cmake -D SOURCE=<source> -D BINARY=<build> -D WORK=<folder> -D COMPILER=<c++> -P check_examples.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "${command}\nended with ${failed}:\n${output}")
  endif()
endfunction()

function(expect file pattern what)
  file(READ ${WORK}/run/${file} text)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "${what}: no, nothing in ${WORK}/run/${file} matches '${pattern}'")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BINARY} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE}/examples -B ${WORK}/build -D CMAKE_PREFIX_PATH=${WORK}/prefix
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_BUILD_TYPE=Debug)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/prefix/bin/lamp-slam ${SOURCE}/examples/stages.ini --out ${WORK}/run
  --set plugins.load=${WORK}/build/liblamp_examples.so --set pipeline.exporters=)

expect(config.ini "max_angle_deg = 60\n" "SameHeading has its option from the ini")
expect(loops.csv ",SameHeading,[^,]*,[0-9.]*[1-9][0-9.]*,[0-9]+,verified,"
  "candidates of SameHeading, with a priority of MostUncertain's, become loop closures")
expect(summary.json "trimmed in [0-9]+ rounds" "TrimmedLm is the optimizer")
