add_library(lamp_warnings INTERFACE)
# GCC 12 sees uninitialised members in moved std::variant and std::optional where there are none.
target_compile_options(lamp_warnings INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
if(LAMP_WARNINGS_AS_ERRORS)
  target_compile_options(lamp_warnings INTERFACE -Werror)
endif()
if(LAMP_SANITIZE)
  # Undefined behaviour ends the program, as all else that is found does.
  add_compile_options(-fsanitize=${LAMP_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LAMP_SANITIZE})
endif()
