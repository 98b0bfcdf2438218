// The cut into chunks, and their processing on threads.
#pragma once

#include <hwy/cache_control.h>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "frontend/mesh_clusters.h"
#include "frontend/tasks.h"

namespace edgewise {

// Vertices or triangles begin … end - 1 of a part, which has this index in its group.
struct PartRange {
  std::size_t part, begin, end;
  VertexRange allowed;  // of triangles: vertices that they may name
};

// Cuts the vertices or triangles of several meshes into chunks of kChunkTriangles: a large mesh spans many
// chunks, and one chunk spans many small meshes.
class Chunks {
 public:
  void clear() {
    ranges_.clear();
    ends_.clear();
    total_ = room_ = 0;
  }
  // Makes room for `count` elements from up to `ranges` calls of add().
  void reserve(std::size_t count, std::size_t ranges) {
    const std::size_t chunks = count / kChunkTriangles + 1;
    ranges_.reserve(ranges + chunks);
    ends_.reserve(chunks);
  }
  // Appends `count` elements from index `first` on.
  void add(std::size_t part, std::size_t first, std::size_t count, VertexRange allowed = {}) {
    const std::size_t last = first + count;
    for (std::size_t begin = first, end; begin < last; begin = end) {
      if (room_ == 0) {
        ends_.push_back(ranges_.size());
        room_ = kChunkTriangles;
      }
      end = std::min(last, begin + room_);
      ranges_.push_back({part, begin, end, allowed});
      ++ends_.back();
      room_ -= end - begin;
    }
    total_ += count;
  }

  std::size_t size() const { return ends_.size(); }  // chunks
  std::span<const PartRange> operator[](std::size_t chunk) const {
    const std::size_t first = chunk == 0 ? 0 : ends_[chunk - 1];
    return {ranges_.data() + first, ends_[chunk] - first};
  }
  std::size_t total() const { return total_; }  // elements

 private:
  std::vector<PartRange> ranges_;
  std::vector<std::size_t> ends_;     // the end of each chunk in ranges_
  std::size_t total_ = 0, room_ = 0;  // elements: in all chunks; that still fit the last chunk
};

// Processes chunks of triangles in parallel and keeps their output in order, without a second pass over it.
// Workers take chunks in order, and each fills a buffer of its own. A worker then waits until all earlier
// chunks have added their lengths to the total. It reads its chunk's position from the total, adds its own
// length, passes the turn on, and copies its output to that position.
//
// The lowest unfinished chunk waits for no other, so there is no deadlock.
class InOrder {
 public:
  void start_frame(int threads, bool with_unsnapped) {
    threads_ = threads;
    total_ = 0;
    if (outputs_.size() < static_cast<std::size_t>(threads))
      outputs_.resize(static_cast<std::size_t>(threads));
    for (ChunkOutput& out : outputs_) {
      out.reserve(with_unsnapped);
      out.stats = {};
    }
  }

  // For each chunk, calls make(chunk, output), which must fill the empty output, and then place(output, at),
  // where `at` is the number of triangles before the chunk's. The chunks have `count` input triangles in all.
  // Neither function may throw.
  template <typename Make, typename Place>
  void for_each_chunk(std::size_t chunks, std::size_t count, Make&& make, Place&& place) {
    const int workers = workers_for(count, threads_);
    std::atomic<std::size_t> next{0};
    std::atomic<std::uint32_t> turn{0};
    parallel_for(workers, workers, [&](int worker) {
      ChunkOutput& out = outputs_[static_cast<std::size_t>(worker)];
      for (std::size_t chunk; (chunk = next.fetch_add(1, std::memory_order_relaxed)) < chunks;) {
        out.count = 0;
        make(chunk, out);
        wait_until(turn, static_cast<std::uint32_t>(chunk));
        const std::size_t at = total_;
        total_ += out.count;
        turn.store(static_cast<std::uint32_t>(chunk + 1), std::memory_order_release);
        turn.notify_all();
        place(out, at);
      }
    });
  }

  // A worker's own, for callers that need no order.
  ChunkOutput& output(int worker) { return outputs_[static_cast<std::size_t>(worker)]; }
  std::size_t total() const { return total_; }  // output triangles since start_frame()
  FrontendStats stats() const {
    FrontendStats sum;
    for (const ChunkOutput& out : outputs_) sum += out.stats;
    return sum;
  }

 private:
  // Spins for about 20 us before it sleeps: a chunk takes less time, and waking a thread takes more.
  static void wait_until(const std::atomic<std::uint32_t>& turn, std::uint32_t chunk) {
    const auto has_come = [&] { return turn.load(std::memory_order_acquire) == chunk; };
    constexpr int kSpins = 2000;
    for (int i = 0; i < kSpins; ++i) {
      if (has_come()) return;
      hwy::Pause();
    }
    for (std::uint32_t now; (now = turn.load(std::memory_order_acquire)) != chunk;)
      turn.wait(now, std::memory_order_acquire);
  }

  int threads_ = 1;
  std::size_t total_ = 0;
  std::vector<ChunkOutput> outputs_;  // one per worker
};

}  // namespace edgewise
