#include "image/netpbm.h"

#include <cstdio>
#include <utility>

#include "core/numbers.h"
#include "edgewise/contract.h"

namespace edgewise::netpbm {

namespace {

// Longer than any valid word, and short enough for a message.
constexpr std::size_t kMaxWord = 32;

bool is_blank(int c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace

Size checked_size(const std::filesystem::path& path, std::uint64_t width, std::uint64_t height) {
  const auto is_side = [](std::uint64_t px) {
    return px >= 1 && px <= std::uint64_t{contract::kMaxImageSide};
  };
  if (!is_side(width) || !is_side(height))
    throw FileError(path, "image size " + std::to_string(width) + "x" + std::to_string(height) +
                              " is outside 1 to " + std::to_string(contract::kMaxImageSide));
  return {static_cast<int>(width), static_cast<int>(height)};
}

void check_pixels(const std::filesystem::path& path, int width, int height, std::size_t pixels) {
  const auto side = [](int px) { return static_cast<std::uint64_t>(std::max(px, 0)); };
  if (checked_size(path, side(width), side(height)).pixels() != pixels)
    throw FileError(path, "cannot be written: " + std::to_string(pixels) + " pixels don't make an image of " +
                              std::to_string(width) + "x" + std::to_string(height));
}

Reader::Reader(const std::filesystem::path& path, InputFile file, std::string_view magics)
    : path_(path), file_(std::move(file)) {
  std::string magic(2, '\0');
  file_.stream->read(magic.data(), 2);
  if (magic[0] == 'P' && magics.find(magic) != magics.npos) kind_ = magic[1], end_ = next();
  if (!is_blank(end_)) throw FileError(path_, "does not start with " + std::string(magics));
}

// The next character. A comment counts as the line end behind it, even if it begins inside a word.
int Reader::next() {
  int c = file_.stream->get();
  if (c != '#') return c;
  while (c != '\n' && c != '\r' && *file_.stream) c = file_.stream->get();
  return c;
}

void Reader::skip_blanks() {
  do {
    const int before = end_;
    end_ = next();
    if (before == '\r' && end_ == '\n') crlf_ = true;
  } while (is_blank(end_));
}

std::string Reader::word() {
  std::string word;
  skip_blanks();
  for (; word.size() < kMaxWord && end_ > ' ' && end_ <= '~'; end_ = next())
    word.push_back(static_cast<char>(end_));
  if (word.empty() || !(is_blank(end_) || (end_ == EOF && is_plain())))
    throw FileError(path_, "malformed or truncated " + std::string(is_plain() ? "text" : "header"));
  return word;
}

std::uint64_t Reader::integer(const char* noun) {
  const std::string text = word();
  const auto value = parsed<std::uint64_t>(text);
  if (!value) throw FileError(path_, "malformed: '" + text + "' is not a " + noun);
  return *value;
}

Size Reader::size() {
  const std::uint64_t width = integer(), height = integer();
  return checked_size(path_, width, height);
}

void Reader::begin_plain(std::uint64_t samples) {
  const std::uint64_t rest = end_ == EOF ? 0 : file_.size - static_cast<std::uint64_t>(file_.stream->tellg());
  if (rest + 1 < 2 * samples)  // each has a digit, and a blank before the next one
    throw FileError(path_, "truncated: header promises " + std::to_string(samples) + " samples, " +
                               std::to_string(rest) + " bytes follow");
}

void Reader::end_plain() {
  skip_blanks();
  if (end_ != EOF) throw FileError(path_, "too long: text follows the last sample");
}

void Reader::check_rest(std::uint64_t bytes) {
  std::istream& in = *file_.stream;
  std::uint64_t rest = file_.size - static_cast<std::uint64_t>(in.tellg());
  // LF behind CR ends the header if earlier lines ended in CR LF. Otherwise it may be the first sample, if
  // their number is right.
  if (end_ == '\r' && in.peek() == '\n' && (crlf_ || rest != bytes)) {
    in.get();
    --rest;
  }
  if (rest != bytes)
    throw FileError(path_, (rest < bytes ? "truncated" : "too long") + std::string(": header promises ") +
                               std::to_string(bytes) + " bytes, " + std::to_string(rest) + " follow");
}

void Reader::read(void* samples, std::size_t bytes) {
  if (!file_.stream->read(static_cast<char*>(samples), static_cast<std::streamsize>(bytes)))
    throw FileError(path_, "cannot be read to its end");
}

}  // namespace edgewise::netpbm
