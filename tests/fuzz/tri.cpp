// Reads any bytes as a .tri file: the result is either an error message, or a stream that can be drawn and is
// written as the same bytes (TRI1 if it has no triangle).
#include <sstream>
#include <stdexcept>

#include "edgewise/tri_file.h"
#include "fuzz.h"

using namespace edgewise;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(data, size);
  TriangleStream stream;
  try {
    stream = read_tri(file.path());
  } catch (const std::runtime_error&) {
    return 0;
  }
  std::ostringstream again;
  write_tri(again, stream);
  std::string read(reinterpret_cast<const char*>(data), size);
  if (stream.size() == 0) read[3] = '1';
  fuzz::require(again.view() == read, "the stream is written as other bytes than were read");
  const int width = stream.width, height = stream.height;
  fuzz::check_frontend(std::move(stream), width, height);
  return 0;
}
