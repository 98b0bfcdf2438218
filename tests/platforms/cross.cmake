# Toolchain for another processor: Debian's cross compiler, whose programs QEMU runs. scripts/platforms.sh sets
# EDGEWISE_PROCESSOR, for example aarch64. EDGEWISE_SYSROOT is a folder of Debian's packages for it; without, the
# library alone is built.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES EDGEWISE_PROCESSOR EDGEWISE_SYSROOT)
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${EDGEWISE_PROCESSOR})
set(CMAKE_CXX_COMPILER ${EDGEWISE_PROCESSOR}-linux-gnu-g++)
add_compile_options(-Wno-psabi) # no notes about other versions of GCC
if(EDGEWISE_SYSROOT)
  set(CMAKE_SYSROOT ${EDGEWISE_SYSROOT})
  set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
  set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
  set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
  set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
else()
  include("${CMAKE_CURRENT_LIST_DIR}/headers.cmake")
endif()
