// The size of the machine's last cache, as the processor tells it to whoever asks; others may use it, too.
#pragma once

#include <cstddef>

namespace edgewise {

std::size_t llc_bytes();

}  // namespace edgewise
