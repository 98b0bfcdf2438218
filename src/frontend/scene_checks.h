// Checks that the front end, the queries and the interfaces for C and Python share. They throw
// std::invalid_argument.
#pragma once

#include <cstddef>
#include <cstdint>

#include "edgewise/scene.h"

namespace edgewise {

// Returns `triangles` unless a frame cannot have so many, with ids from `first_id` on.
std::size_t checked_count(std::uint64_t triangles, std::uint32_t first_id = 0);

// FrontendOptions::subpixel_bits.
void check_subpixel_bits(int bits);
// One of its two lists is empty.
void check(const TriangleStream& stream);

const Mesh& mesh_of(const Scene& scene, const Instance& instance);

// `what` names what is counted.
void check_index(const char* what, std::size_t index, std::size_t count);
void check_count(const char* what, std::size_t given, std::size_t count);

// There is one of `what` per triangle.
void check_per_triangle(const Mesh& mesh, std::size_t given, const char* what);
// The flags are empty or one per triangle.
void check_flags(const Mesh& mesh);

// The mesh has the part's triangles.
void check_part(const Mesh& mesh, const MeshPart& part);

// All vertices that triangles name exist.
void check_vertices(const Mesh& mesh);

}  // namespace edgewise
