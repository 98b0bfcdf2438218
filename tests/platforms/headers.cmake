# For toolchains of platforms without packages: the library alone, without threads, and of the machine's own headers
# only those of libraries without code that depends on the processor.
set(EDGEWISE_THREADS OFF CACHE BOOL "")
set(EDGEWISE_FILES OFF CACHE BOOL "")
set(EDGEWISE_LABORATORY OFF CACHE BOOL "")
set(headers "${CMAKE_BINARY_DIR}/headers")
foreach(library glm hwy)
  set(${library}_DIR "${headers}")
  file(WRITE "${headers}/${library}Config.cmake" "add_library(${library}::${library} INTERFACE IMPORTED)
target_include_directories(${library}::${library} INTERFACE \"${headers}\")\n")
endforeach()
foreach(header glm hwy xxhash.h)
  if(NOT EXISTS "/usr/include/${header}")
    message(FATAL_ERROR "/usr/include/${header} is missing; Debian's libglm-dev, libhwy-dev and libxxhash-dev have these headers")
  endif()
  file(CREATE_LINK "/usr/include/${header}" "${headers}/${header}" SYMBOLIC)
endforeach()
file(CREATE_LINK /usr/include/fmt "${headers}/fmt" SYMBOLIC) # for the page
set(XXHASH_INCLUDE "${headers}")
