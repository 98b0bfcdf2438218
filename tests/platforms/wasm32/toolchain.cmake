# Toolchain for WebAssembly outside of a browser: clang with WASI's libraries, run by Node. These have no threads, no
# file streams and no exceptions (exceptions.cpp). Add -DCMAKE_CXX_FLAGS=-msimd128 for 128-bit vectors.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_STANDARD_LIBRARIES "${CMAKE_CURRENT_LIST_DIR}/exceptions.cpp")
include("${CMAKE_CURRENT_LIST_DIR}/../headers.cmake")
