// Every public header includes this one first.
#pragma once

// A header that doesn't exist stops GCC and Clang at once; after #error, hundreds of other errors follow.
#if __cplusplus < 202002L
#include "Edgewise needs C++20: compile with -std=c++20"
#endif
