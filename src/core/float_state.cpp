#include "core/float_state.h"

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

namespace edgewise {

#ifdef __x86_64__
// Saves only MXCSR: the library does not use x87, whose state is slow to change.
DefaultFloatState::DefaultFloatState() : callers_(_mm_getcsr()) {
  constexpr unsigned kDefault = _MM_MASK_MASK | _MM_ROUND_NEAREST | _MM_FLUSH_ZERO_OFF;
  if ((callers_ & ~unsigned{_MM_EXCEPT_MASK}) != kDefault) _mm_setcsr(kDefault);
}
DefaultFloatState::~DefaultFloatState() {
  if (_mm_getcsr() != callers_) _mm_setcsr(callers_);
}
#else
DefaultFloatState::DefaultFloatState() {
  std::fegetenv(&callers_);
  std::fesetenv(FE_DFL_ENV);
}
DefaultFloatState::~DefaultFloatState() {
  std::fesetenv(&callers_);
}
#endif

}  // namespace edgewise
