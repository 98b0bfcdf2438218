// Stops compilers in a mode older than C++20. Every public header includes this one first. The visibility
// pragmas of a header make shared libraries export what it declares, whatever the flags of the compiler.
#pragma once

// GCC and Clang stop at once if an included file does not exist. After #error they would go on and print
// hundreds of other errors.
#if __cplusplus < 202002L
#include "Edgewise needs C++20: compile with -std=c++20"
#endif
