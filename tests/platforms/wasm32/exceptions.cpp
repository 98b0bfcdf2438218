// What WASI's C++ library lacks: an exception prints its message and ends the program with status 2, as
// main() would.
#include <cstdio>
#include <cstdlib>
#include <exception>

extern "C" {

void* __cxa_allocate_exception(std::size_t size) {
  return std::malloc(size);
}

// All that the project throws begins with its base std::exception.
[[noreturn]] void __cxa_throw(void* thrown, void*, void (*)(void*)) {
  std::fprintf(stderr, "%s\n", static_cast<const std::exception*>(thrown)->what());
  std::exit(2);
}

}  // extern "C"
