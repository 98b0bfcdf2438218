// What a scene or stream holds, as arrays: for pickles, copies, and the getters of Python.
#pragma once

#include <memory>
#include <optional>

#include "python/drawn.h"

namespace edgewise::python {

std::unique_ptr<Drawn> stream(const Floats& vertices, int width, int height,
                              const std::optional<Words>& colours);

void define_state(py::class_<Drawn>& drawn_class);

}  // namespace edgewise::python
