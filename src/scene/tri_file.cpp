// The triangles have the same layout in the file and in memory, but for the byte order and, in double,
// padding.
#include "edgewise/tri_file.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "core/little_endian.h"
#include "edgewise/contract.h"
#include "edgewise/limits.h"
#include "scene/tri_input.h"

namespace edgewise {

namespace {

static_assert(std::is_trivially_copyable_v<StreamTriangle> &&
              std::is_trivially_copyable_v<ExactStreamTriangle>);
constexpr std::size_t kExactBytes = sizeof ExactStreamTriangle::vertex + sizeof ExactStreamTriangle::colour;
static_assert(offsetof(ExactStreamTriangle, colour) == sizeof ExactStreamTriangle::vertex);

constexpr std::uint32_t kTri1 = 'T' | 'R' << 8 | 'I' << 16 | '1' << 24, kTri2 = kTri1 + (1 << 24);
using Header = std::array<std::uint32_t, 4>;  // magic, width, height, count

bool is_side(std::uint32_t px) {
  return px >= 1 && px <= std::uint32_t{contract::kMaxImageSide};
}

std::string count_text(std::uint64_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

Header read_header(const std::filesystem::path& path, InputFile& file) {
  Header header{};
  file.stream->read(reinterpret_cast<char*>(header.data()), sizeof header);
  convert_words(std::as_writable_bytes(std::span(header)), std::endian::little);
  if (file.stream->gcount() >= 4 && header[0] != kTri1 && header[0] != kTri2)
    throw FileError(path, "is not a triangle stream (it does not start with TRI1 or TRI2)");
  if (!*file.stream)
    throw FileError(path, "truncated: the header has 16 bytes, the file " + std::to_string(file.size));
  if (!is_side(header[1]) || !is_side(header[2]))
    throw FileError(path, "image size " + std::to_string(header[1]) + "x" + std::to_string(header[2]) +
                              " is outside 1 to " + std::to_string(contract::kMaxImageSide));
  return header;
}

}  // namespace

TriangleStream read_tri(const std::filesystem::path& path) {
  return read_tri(path, open_input(path));
}

TriangleStream read_tri(const std::filesystem::path& path, InputFile file) {
  const auto [magic, width, height, count] = read_header(path, file);

  const std::uint64_t promised = count * std::uint64_t{magic == kTri2 ? kExactBytes : sizeof(StreamTriangle)};
  const std::uint64_t follow = file.size - sizeof(Header);
  if (follow != promised)
    throw FileError(path, (follow < promised ? "truncated" : "too long") + std::string(": header promises ") +
                              count_text(count, "triangle") + " (" + count_text(promised, "byte") + "), " +
                              count_text(follow, "byte") + (follow == 1 ? " follows" : " follow"));

  if (count > kMaxTriangles)
    throw FileError(path,
                    "has " + count_text(count, "triangle") + ", more than " + std::to_string(kMaxTriangles));

  TriangleStream stream{static_cast<int>(width), static_cast<int>(height), {}};
  const auto read = [&](void* to, std::uint64_t bytes) {
    if (!file.stream->read(static_cast<char*>(to), static_cast<std::streamsize>(bytes)))
      throw FileError(path, "cannot be read to its end");
  };
  if (magic == kTri2) {
    stream.exact.resize(count);
    for (ExactStreamTriangle& t : stream.exact) {
      read(&t, kExactBytes);
      convert_words(std::as_writable_bytes(std::span(t.vertex)), std::endian::little, sizeof(double));
      t.colour = little_endian(t.colour);
    }
  } else {
    stream.triangles.resize(count);
    read(stream.triangles.data(), promised);
    convert_words(std::as_writable_bytes(std::span(stream.triangles)), std::endian::little);
  }
  return stream;
}

void write_tri(std::ostream& out, const TriangleStream& stream) {
  const auto width = static_cast<std::uint32_t>(stream.width),
             height = static_cast<std::uint32_t>(stream.height);
  if (!is_side(width) || !is_side(height))
    throw std::invalid_argument("a stream's image size is out of range");
  const std::size_t count = stream.size();
  const bool exact = !stream.exact.empty();
  if (exact && !stream.triangles.empty())
    throw std::invalid_argument("a .tri file holds triangles in float or in double, not both");
  if (count > kMaxTriangles)
    throw std::invalid_argument("a .tri file holds at most " + std::to_string(kMaxTriangles) + " triangles");

  const Header header{exact ? kTri2 : kTri1, width, height, static_cast<std::uint32_t>(count)};
  write_words(out, std::as_bytes(std::span(header)));
  write_words(out, std::as_bytes(std::span(stream.triangles)));
  for (const ExactStreamTriangle& t : stream.exact) {
    write_words(out, std::as_bytes(std::span(t.vertex)), sizeof(double));
    write_words(out, std::as_bytes(std::span(&t.colour, 1)));
  }
}

}  // namespace edgewise
