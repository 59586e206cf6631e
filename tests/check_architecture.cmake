# Fails if a file under modules/<module>/{include,src} includes a header of a module that the table in
# docs/architecture.md does not allow it, or if that table and the folders in modules/ differ.
#
#   cmake -D ROOT=<folder with docs/ and modules/> -P check_architecture.cmake
cmake_minimum_required(VERSION 3.22)

set(faults "")

# Rows: | `module` | `used`, `used` | ... |
file(STRINGS ${ROOT}/docs/architecture.md rows REGEX "^\\| `[a-z_]+` \\|")
set(modules "")
foreach(row IN LISTS rows)
  string(REGEX MATCH "^\\| `([a-z_]+)` \\|([^|]*)\\|" _ "${row}")
  set(module ${CMAKE_MATCH_1})
  string(REGEX MATCHALL "[a-z_]+" allowed_${module} "${CMAKE_MATCH_2}")
  list(APPEND modules ${module})
  if(NOT IS_DIRECTORY ${ROOT}/modules/${module})
    list(APPEND faults "docs/architecture.md: there is no folder modules/${module}")
  endif()
endforeach()

file(GLOB folders LIST_DIRECTORIES true RELATIVE ${ROOT}/modules ${ROOT}/modules/*)
foreach(module IN LISTS folders)
  if(NOT IS_DIRECTORY ${ROOT}/modules/${module})
    continue()
  endif()
  if(NOT module IN_LIST modules)
    list(APPEND faults "docs/architecture.md: the table has no row for modules/${module}")
    continue()
  endif()
  file(GLOB_RECURSE files RELATIVE ${ROOT}
    ${ROOT}/modules/${module}/include/*.h ${ROOT}/modules/${module}/src/*.h
    ${ROOT}/modules/${module}/src/*.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${ROOT}/${file} includes REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]lamp/")
    foreach(include IN LISTS includes)
      string(REGEX MATCH "lamp/([a-z_]+)/" _ "${include}")
      set(used ${CMAKE_MATCH_1})
      if(NOT used STREQUAL module AND NOT used IN_LIST allowed_${module})
        list(APPEND faults "${file}: ${module} may not use ${used} (docs/architecture.md)")
      endif()
    endforeach()
  endforeach()
endforeach()

if(NOT modules)
  list(APPEND faults "docs/architecture.md: no table of modules was found")
endif()
if(faults)
  list(JOIN faults "\n" text)
  message("${text}")
  message(FATAL_ERROR "The include rule is broken.")
endif()
