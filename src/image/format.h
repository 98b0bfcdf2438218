// The formats of pictures and depth files.
#pragma once

#include <filesystem>
#include <optional>

#include "edgewise/image.h"

namespace edgewise {

enum class Format { png, ppm, pfm };

// By the extension.
std::optional<Format> format_of(const std::filesystem::path& path);

// By the extension, or of /dev/stdin and other descriptors by the first bytes.
std::optional<Format> format_of_input(const std::filesystem::path& path);

// Writes a PNG or a PPM, whatever the name.
void write_image(const std::filesystem::path& path, const Image& image, Format format);

}  // namespace edgewise
