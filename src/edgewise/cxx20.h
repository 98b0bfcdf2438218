// Stops compilers in a mode older than C++20. Every public header includes this one first.
#pragma once

// GCC and Clang stop at once if an included file does not exist. After #error they would go on and print
// hundreds of other errors.
#if __cplusplus < 202002L
#include "Edgewise needs C++20: compile with -std=c++20"
#endif

// Of the namespaces in public headers: shared libraries export what they declare, whatever the compiler's
// flags.
#define EDGEWISE_PUBLIC [[gnu::visibility("default")]]
