// Preloaded, this library replaces those functions of libm that IEEE 754 does not specify exactly. Their
// results are off by about 2^-20, more than those of any two libraries: an error of one unit in a double's
// last place would mostly vanish when the double is rounded to float.
#include <dlfcn.h>

namespace {

template <typename Function>
Function* libm(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

template <typename T>
T wrong(T v) {
  return v + v * T(0x1p-20);
}

}  // namespace

extern "C" {

#define EDGEWISE_ONE(type, name)              \
  type name(type x) noexcept {                \
    return wrong(libm<type(type)>(#name)(x)); \
  }
#define EDGEWISE_TWO(type, name)                       \
  type name(type x, type y) noexcept {                 \
    return wrong(libm<type(type, type)>(#name)(x, y)); \
  }
// GCC calls it for a sine and a cosine of the same angle.
#define EDGEWISE_SINCOS(type, suffix)                                  \
  void sincos##suffix(type x, type* sine, type* cosine) noexcept {     \
    libm<void(type, type*, type*)>("sincos" #suffix)(x, sine, cosine); \
    *sine = wrong(*sine), *cosine = wrong(*cosine);                    \
  }
#define EDGEWISE_ALL(F, name) F(double, name) F(float, name##f) F(long double, name##l)

EDGEWISE_ALL(EDGEWISE_ONE, sin)
EDGEWISE_ALL(EDGEWISE_ONE, cos)
EDGEWISE_ALL(EDGEWISE_ONE, tan)
EDGEWISE_ALL(EDGEWISE_ONE, asin)
EDGEWISE_ALL(EDGEWISE_ONE, acos)
EDGEWISE_ALL(EDGEWISE_ONE, atan)
EDGEWISE_ALL(EDGEWISE_ONE, sinh)
EDGEWISE_ALL(EDGEWISE_ONE, cosh)
EDGEWISE_ALL(EDGEWISE_ONE, tanh)
EDGEWISE_ALL(EDGEWISE_ONE, asinh)
EDGEWISE_ALL(EDGEWISE_ONE, acosh)
EDGEWISE_ALL(EDGEWISE_ONE, atanh)
EDGEWISE_ALL(EDGEWISE_ONE, exp)
EDGEWISE_ALL(EDGEWISE_ONE, exp2)
EDGEWISE_ALL(EDGEWISE_ONE, exp10)
EDGEWISE_ALL(EDGEWISE_ONE, expm1)
EDGEWISE_ALL(EDGEWISE_ONE, log)
EDGEWISE_ALL(EDGEWISE_ONE, log2)
EDGEWISE_ALL(EDGEWISE_ONE, log10)
EDGEWISE_ALL(EDGEWISE_ONE, log1p)
EDGEWISE_ALL(EDGEWISE_ONE, cbrt)
EDGEWISE_ALL(EDGEWISE_ONE, erf)
EDGEWISE_ALL(EDGEWISE_ONE, erfc)
EDGEWISE_ALL(EDGEWISE_ONE, lgamma)
EDGEWISE_ALL(EDGEWISE_ONE, tgamma)
EDGEWISE_ALL(EDGEWISE_TWO, atan2)
EDGEWISE_ALL(EDGEWISE_TWO, hypot)
EDGEWISE_ALL(EDGEWISE_TWO, pow)
EDGEWISE_SINCOS(double, )
EDGEWISE_SINCOS(float, f)
EDGEWISE_SINCOS(long double, l)

}  // extern "C"
