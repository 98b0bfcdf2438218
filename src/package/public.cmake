# Users see the public headers and no others, be it in a build of their own or in an installed copy.
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/include")
file(CREATE_LINK "${PROJECT_SOURCE_DIR}/src/edgewise" "${PROJECT_BINARY_DIR}/include/edgewise" SYMBOLIC)
# A library exports what the public headers declare, by their visibility pragmas, and nothing else. NAME_inside is
# NAME for our own targets, which call internals, too: where NAME is shared, a static library of the same objects.
function(edgewise_public name namespaced headers) # LIBRARIES…: what NAME_inside needs
  add_library(edgewise::${namespaced} ALIAS ${name})
  list(TRANSFORM headers PREPEND "${PROJECT_BINARY_DIR}/include/edgewise/")
  target_sources(${name} INTERFACE FILE_SET HEADERS BASE_DIRS "${PROJECT_BINARY_DIR}/include" FILES ${headers})
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(NOT BUILD_SHARED_LIBS)
    add_library(${name}_inside ALIAS ${name})
    return()
  endif()
  target_link_options(${name} PRIVATE "LINKER:--version-script=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/exports.map")
  add_library(${name}_inside STATIC EXCLUDE_FROM_ALL $<TARGET_OBJECTS:${name}>)
  set_target_properties(${name}_inside PROPERTIES LINKER_LANGUAGE CXX)
  target_include_directories(${name}_inside INTERFACE "${PROJECT_BINARY_DIR}/include")
  target_link_libraries(${name}_inside PUBLIC ${ARGN})
endfunction()
