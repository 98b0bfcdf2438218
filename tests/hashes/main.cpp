// Draws the frames of tests/hashes.json with every combination of backend, SIMD target and thread count, and
// compares their hashes. It needs the library only, and of the machine only that it reads one file.
//
// Combinations take turns, frame by frame, so that each draws at least one frame of every group; one frame of
// every group, or with --all each, is drawn by all.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/parallel.h"
#include "edgewise/draw.h"
#include "edgewise/hash.h"
#include "hashes/frames.h"
#include "lab/cases/backend_comparison.h"

namespace edgewise::hashes {

namespace {

constexpr const char* kUsage = R"(Usage: edgewise_hashes FILE [--frames N | --all | --write | --dump FRAME]
  FILE          tests/hashes.json
  --frames N    draw only N frames, spread evenly, each once
  --all         draw each frame with every combination, not with one in turn
  --write       first write FILE anew, with the hashes of `naive` in scalar code on one thread. Only a
                change of the numeric contract, of a scene or of this list of frames may need it
  --dump FRAME  instead, print each pixel of a frame, its depth and payload, and the bytes of its file if one
                is hashed, to compare two machines
Exit status: 0 all hashes are those of FILE, 1 one is not, 2 bad input.
)";

constexpr int kFramesDescribed = 10;  // of those that differ

using Hashes = std::vector<std::uint32_t>;     // the upper halves of a group's hashes
using Stored = std::map<std::string, Hashes>;  // by group
constexpr const char* kAll = "all";            // the key of the hash over all hashes, in two halves

std::string hex(std::uint64_t value, int digits) {
  char text[17];
  std::snprintf(text, sizeof text, "%0*llx", digits, static_cast<unsigned long long>(value));
  return text;
}

Hashes halves(std::uint64_t hash) {
  return {static_cast<std::uint32_t>(hash >> 32), static_cast<std::uint32_t>(hash)};
}

// An object of strings without escapes: group → 8 hexadecimal digits per frame.
Stored read(const std::string& path) {
  std::string text;  // not by a file stream, which WASI's C++ library lacks
  if (std::FILE* const file = std::fopen(path.c_str(), "r")) {
    for (int c; (c = std::getc(file)) != EOF;) text += static_cast<char>(c);
    std::fclose(file);
  }
  std::vector<std::string> strings;
  for (std::size_t begin = text.find('"'); begin != std::string::npos;) {
    const std::size_t end = text.find('"', begin + 1);
    if (end == std::string::npos) break;
    strings.push_back(text.substr(begin + 1, end - begin - 1));
    begin = text.find('"', end + 1);
  }
  if (strings.empty() || strings.size() % 2 != 0)
    throw std::runtime_error(path + " cannot be read, or holds no hashes");
  Stored stored;
  for (std::size_t i = 0; i < strings.size(); i += 2)
    for (std::size_t at = 0; at + 8 <= strings[i + 1].size(); at += 8)
      stored[strings[i]].push_back(
          static_cast<std::uint32_t>(std::strtoul(strings[i + 1].substr(at, 8).c_str(), nullptr, 16)));
  return stored;
}

void write(const std::string& path, const std::vector<Group>& all, const Stored& stored) {
  std::string text = "{\n";
  const auto line = [&](const std::string& name, const char* end) {
    text += "  \"" + name + "\": \"";
    for (const std::uint32_t hash : stored.at(name)) text += hex(hash, 8);
    text += std::string("\"") + end;
  };
  for (const Group& group : all) line(group.name, ",\n");
  line(kAll, "\n}\n");
  std::FILE* const file = std::fopen(path.c_str(), "w");
  const bool put = file != nullptr && std::fputs(text.c_str(), file) >= 0;
  if (file == nullptr || std::fclose(file) != 0 || !put)
    throw std::runtime_error(path + " cannot be written");
}

struct Combination {
  const BackendInfo* backend;
  SimdTarget target;
  int threads;
};

std::vector<Combination> combinations() {
  std::vector<Combination> all;
  for (const int threads : {1, 3})
    for (const SimdTarget target : supported_targets())
      for (const BackendInfo& backend : backends()) all.push_back({&backend, target, threads});
  return all;
}

// How a combination draws a frame. None of it may change a bit.
struct How {
  Combination by;
  int tile = 64;             // px
  bool whole_frame = false;  // by draw(drawable, …), not by Backend::draw()
  bool odd_layout = false;   // rows are not aligned

  std::string text() const {
    return std::string(by.backend->name) + " on " + std::string(name_of(by.target)) + ", " +
           std::to_string(by.threads) + (by.threads == 1 ? " thread" : " threads") + ", tile " +
           std::to_string(tile) + (whole_frame ? ", in one call" : "");
  }
};
const How kReference{{&find_backend("naive"), SimdTarget::scalar, 1}};

How how_of(const Combination& by, std::size_t turn, const Frame& frame) {
  constexpr std::array kTiles{64, 32, 16};
  return {by, kTiles[turn % 3], turn % 2 == 0 && frame.drawable, turn % 4 < 2};
}

class Painter {
 public:
  // Valid until the next call.
  std::span<const ScreenTriangle> triangles(const Frame& frame, const How& how) {
    if (!frame.drawable) return frame.triangles;
    return frontend_.run(*frame.drawable, frame.frontend, execution_of(how));
  }

  lab::GuardedFrame draw(const Frame& frame, const How& how) {
    lab::GuardedFrame drawn(
        frame.width, frame.height,
        how.odd_layout ? lab::GuardedFrame::Layout{5, 3} : lab::GuardedFrame::aligned(frame.width));
    Backend& backend = backends_.get(*how.by.backend, {});
    if (how.whole_frame)
      edgewise::draw(*frame.drawable, frontend_, frame.frontend, backend, drawn.view(), {frame.background},
                     execution_of(how));
    else
      backend.draw(triangles(frame, how), drawn.view(), {frame.background}, execution_of(how));
    return drawn;
  }

 private:
  static Execution execution_of(const How& how) { return {how.by.threads, how.tile, how.by.target}; }

  Frontend frontend_;
  lab::BackendCache backends_;
};

// The bytes of the file; none if only the picture is hashed.
std::string file_of(const Frame& frame, const ConstFrameView& drawn) {
  return frame.file == nullptr ? "" : frame.file->written(*frame.drawable, drawn);
}

std::uint64_t hash_of(const ConstFrameView& drawn, const std::string& file) {
  std::vector<std::uint64_t> words{edgewise::hash_of(drawn)};
  if (file.empty()) return words[0];
  for (const char byte : file) words.push_back(static_cast<unsigned char>(byte));
  return hash_of_all(words);
}

std::uint64_t hash_of_reference(Painter& painter, const Frame& frame) {
  lab::GuardedFrame drawn = painter.draw(frame, kReference);
  return hash_of(drawn.view(), file_of(frame, drawn.view()));
}

class Check {
 public:
  Check(const std::vector<Group>& all, std::string path, bool by_all)
      : all_(all), path_(std::move(path)), by_all_(by_all) {}

  // Returns the number of frames drawn.
  std::size_t run(const Stored& stored, std::optional<std::size_t> most) {
    std::size_t total = 0, done = 0, drawn = 0;
    for (const Group& group : all_) total += static_cast<std::size_t>(group.frames);
    const std::size_t wanted = std::min(most.value_or(total), total);
    for (std::size_t g = 0; g < all_.size(); ++g) {
      const auto found = stored.find(all_[g].name);
      const auto frames = static_cast<std::size_t>(all_[g].frames);
      if (found == stored.end() || found->second.size() != frames)
        throw std::runtime_error(path_ + " lacks hashes of '" + all_[g].name + "'");
      for (std::size_t i = 0; i < frames; ++i, ++done) {
        if ((done + 1) * wanted / total == done * wanted / total) continue;
        const Frame frame = all_[g].frame(static_cast<int>(i));
        const std::string name = all_[g].name + "/" + std::to_string(i);
        const std::size_t turn = most ? drawn : i + g, n = combinations_.size();
        hashes_.push_back(
            check(frame, name, how_of(combinations_[turn % n], i / n + g, frame), found->second[i]));
        ++drawn;
        if (most || !(by_all_ || i == g % frames)) continue;
        for (const Combination& by : combinations_)
          check(frame, name, how_of(by, i + g, frame), found->second[i]);
        drawn += n;
      }
    }
    if (!most && stored.size() != all_.size() + 1) throw std::runtime_error(path_ + " holds unknown groups");
    return drawn;
  }

  std::uint64_t hash() const { return hash_of_all(hashes_); }
  int wrong() const { return wrong_; }

 private:
  std::uint64_t check(const Frame& frame, const std::string& name, const How& how, std::uint32_t stored) {
    lab::GuardedFrame drawn = painter_.draw(frame, how);
    const std::string file = file_of(frame, drawn.view());
    const std::uint64_t hash = hash_of(drawn.view(), file);
    const bool right = hash >> 32 == stored;
    const bool reread = !right || file.empty() || frame.file->reread(name, file) == file;
    if (right && reread && drawn.written_outside() == 0) return hash;
    if (++wrong_ > kFramesDescribed) return hash;
    std::printf("%s: drawn by %s, the hash begins with %s, %s", name.c_str(), how.text().c_str(),
                hex(hash >> 32, 8).c_str(), right ? "which is right" : ("not " + hex(stored, 8)).c_str());
    std::string why;
    if (drawn.written_outside() != 0) why += "\n  wrote words beside the image";
    if (!reread) why += "\n  the file, read and written again, has other bytes";
    if (!right && hash_of_reference(painter_, frame) >> 32 == stored)
      why += "\n  naive in scalar code is right";
    else if (!right)
      why +=
          "\n  naive in scalar code is wrong, too. So the contract, the scene, the file format or the build "
          "differs from the one that wrote " +
          path_ + ".\n  To find the pixel" + (frame.file == nullptr ? "" : " or the file's byte") +
          ", dump the frame here and where the hash is right:\n    edgewise_hashes " + path_ + " --dump '" +
          name + "'";
    std::printf("%s\n", why.c_str());
    return hash;
  }

  const std::vector<Group>& all_;
  const std::string path_;
  const bool by_all_;  // not only one frame of each group
  const std::vector<Combination> combinations_ = combinations();
  Painter painter_;
  std::vector<std::uint64_t> hashes_;
  int wrong_ = 0;
};

Stored hashes_of_reference(const std::vector<Group>& all) {
  Painter painter;
  Stored stored;
  std::vector<std::uint64_t> hashes;
  for (const Group& group : all)
    for (int i = 0; i < group.frames; ++i) {
      hashes.push_back(hash_of_reference(painter, group.frame(i)));
      stored[group.name].push_back(static_cast<std::uint32_t>(hashes.back() >> 32));
    }
  stored[kAll] = halves(hash_of_all(hashes));
  return stored;
}

void dump(const std::vector<Group>& all, std::string_view name) {
  for (const Group& group : all)
    for (int i = 0; i < group.frames; ++i) {
      if (name != group.name + "/" + std::to_string(i)) continue;
      const Frame frame = group.frame(i);
      Painter painter;
      lab::GuardedFrame drawn = painter.draw(frame, kReference);
      for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
          std::printf("%d %d: depth %s, payload %s\n", x, y, hex(drawn.depth_row(y)[x], 8).c_str(),
                      hex(drawn.payload_row(y)[x], 8).c_str());
      const std::string file = file_of(frame, drawn.view());
      for (std::size_t at = 0; at < file.size(); ++at) {
        if (at % 16 == 0) std::printf("%sfile, byte %zu:", at == 0 ? "" : "\n", at);
        std::printf(" %s", hex(static_cast<unsigned char>(file[at]), 2).c_str());
      }
      if (!file.empty()) std::printf("\n");
      return;
    }
  throw std::invalid_argument("no frame '" + std::string(name) + "'");
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments[0].starts_with('-')) throw std::invalid_argument(kUsage);
  const std::string& path = arguments[0];
  const std::string option = arguments.size() > 1 ? arguments[1] : "";
  const bool writes = option == "--write", dumps = option == "--dump", brief = option == "--frames",
             by_all = option == "--all";
  const std::size_t values = dumps || brief ? 1 : 0;
  if ((!option.empty() && !writes && !dumps && !brief && !by_all) ||
      arguments.size() != 1 + (option.empty() ? 0 : 1 + values))
    throw std::invalid_argument(kUsage);
  const std::vector<Group> all = groups();
  if (dumps) return dump(all, arguments[2]), 0;
  std::optional<std::size_t> most;
  if (brief) {
    const std::string& text = arguments[2];
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc{} || end != text.data() + text.size() || count == 0)
      throw std::invalid_argument("--frames: '" + text + "' is not a count");
    most = count;
  }
  if (writes) write(path, all, hashes_of_reference(all));

  const Stored stored = read(path);
  Check check(all, path, by_all);
  const std::size_t drawn = check.run(stored, most);
  const bool all_right = most || stored.at(kAll) == halves(check.hash());
  std::printf("%zu frames of %zu groups, drawn by %zu combinations of backend, SIMD target and threads: ",
              drawn, all.size(), combinations().size());
  if (check.wrong() != 0)
    std::printf("%d DIFFER\n", check.wrong());
  else if (!all_right)
    std::printf("the hash of all is %s, NOT that of the file\n", hex(check.hash(), 16).c_str());
  else
    std::printf("no hash differs%s\n", most ? "" : (", all: " + hex(check.hash(), 16)).c_str());
  return check.wrong() == 0 && all_right ? 0 : 1;
}

}  // namespace

}  // namespace edgewise::hashes

int main(int count, char** arguments) try {
  edgewise::allow_more_threads_than_cores();
  return edgewise::hashes::run({arguments + 1, arguments + count});
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 2;
}
