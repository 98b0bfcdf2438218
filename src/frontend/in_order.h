// Ranges of triangles that threads make at the same time, and their output in order.
#pragma once

#include <hwy/cache_control.h>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "frontend/tasks.h"

namespace edgewise {

// Workers take ranges in order, and make a range into a buffer. Once all earlier ranges are finished, the
// worker moves what it has made to its place in the output, and makes the rest of the range there. A range
// that is finished before gets its position when the earlier ones are finished, and its worker copies it
// before it takes its next range. Until then the worker makes other ranges into other buffers. It waits only
// if no buffer is free.
//
// The lowest unfinished range waits for no other, so there is no deadlock.
class InOrder {
 public:
  static constexpr std::size_t kBuffers = 3;  // per worker: to fill one while two wait for their positions

  // A range has up to `inputs` triangles, few of which are clipped.
  void start_frame(int threads, std::size_t inputs, bool with_unsnapped) {
    total_ = 0;
    with_unsnapped_ = with_unsnapped;
    const std::size_t count = static_cast<std::size_t>(threads) * kBuffers;
    if (slots_.size() < count) slots_ = std::vector<Slot>(count);
    for (Slot& slot : slots_) {
      slot.buffers.reserve(inputs + ChunkOutput::kChunkRoom, with_unsnapped);
      slot.out.stats = {};
    }
  }

  // For each range, calls make(worker, range, output, ready), which must append the range's triangles to the
  // output and call ready() before each chunk of them. At the end, all triangles lie in `visible`; some are
  // missing if it lacks room for total() + kChunkRoom. No function may throw.
  template <typename Make>
  void for_each_range(std::size_t ranges, int workers, TriangleBuffers& visible, Make&& make) {
    const auto place = [&](const ChunkOutput& out, std::size_t at) {
      if (at + out.count > visible.screen.capacity() || out.triangles == visible.screen.data() + at) return;
      std::copy_n(out.triangles, out.count, visible.screen.data() + at);
      if (with_unsnapped_) std::copy_n(out.unsnapped, out.count, visible.unsnapped.data() + at);
    };
    std::atomic<std::size_t> next{0};
    turn_ = 0;
    finished_.assign(ranges, nullptr);
    parallel_for(workers, workers, [&](int worker) {
      const std::span<Slot> mine = slots_of(worker);
      // Places what has a position until `until` returns a slot, or true.
      const auto place_until = [&](auto&& until) {
        for (;;) {
          const std::uint32_t turn = turn_.load(std::memory_order_acquire);
          for (Slot& slot : mine) {
            const std::size_t at = slot.position.load(std::memory_order_acquire);
            if (at >= kPending) continue;
            place(slot.out, at);
            slot.position.store(kFree, std::memory_order_relaxed);
          }
          if (const auto result = until(turn)) return result;
          wait_for_other(turn);
        }
      };
      const auto is_free = [](const Slot& slot) { return slot.position == kFree; };
      const auto free_slot = [&](std::uint32_t) {
        const auto slot = std::ranges::find_if(mine, is_free);
        return slot == mine.end() ? nullptr : &*slot;
      };
      for (;;) {
        Slot& slot = *place_until(free_slot);
        const std::size_t range = next.fetch_add(1, std::memory_order_relaxed);
        if (range >= ranges) break;
        ChunkOutput& out = slot.out;
        out.write_to(slot.buffers, 0);
        const auto is_lowest = [&](std::uint32_t turn) { return turn == range; };
        make(worker, range, out, [&] {
          const bool in_place = out.triangles != slot.buffers.screen.data();
          if (out.has_room() && (in_place || !is_lowest(turn_.load(std::memory_order_acquire)))) return;
          place_until(is_lowest);
          place(out, total_);
          total_ += out.count;
          const bool fits = total_ + ChunkOutput::kChunkRoom <= visible.screen.capacity();
          fits ? out.write_to(visible, total_) : out.write_to(slot.buffers, 0);
        });
        slot.position.store(kPending, std::memory_order_relaxed);
        finish(range, slot);
      }
      place_until([&](std::uint32_t) { return std::ranges::all_of(mine, is_free); });
    });
  }

  // A worker's own, emptied, for callers that need no order.
  ChunkOutput& output(int worker) {
    Slot& slot = slots_of(worker).front();
    slot.out.write_to(slot.buffers, 0);
    return slot.out;
  }
  std::size_t total() const { return total_; }  // output triangles since start_frame()
  FrontendStats stats() const {
    FrontendStats sum;
    for (const Slot& slot : slots_) sum += slot.out.stats;
    return sum;
  }

 private:
  // Instead of a position.
  static constexpr std::size_t kFree = ~std::size_t{0}, kPending = kFree - 1;

  struct Slot {
    TriangleBuffers buffers;
    ChunkOutput out;
    std::atomic<std::size_t> position{kFree};
  };

  std::span<Slot> slots_of(int worker) {
    return std::span(slots_).subspan(static_cast<std::size_t>(worker) * kBuffers, kBuffers);
  }

  // Gives positions to this range and the finished ones after it, if all before it have theirs.
  void finish(std::size_t range, Slot& slot) {
    while (locked_.test_and_set(std::memory_order_acquire)) hwy::Pause();
    finished_[range] = &slot;
    const bool its_turn = turn_ == range;
    if (its_turn) {
      std::uint32_t turn = turn_;
      for (; turn < finished_.size() && finished_[turn] != nullptr; ++turn) {
        const std::size_t at = total_;
        total_ += finished_[turn]->out.count;  // first, since the worker may then reuse the output
        finished_[turn]->position.store(at, std::memory_order_release);
      }
      turn_.store(turn, std::memory_order_release);
    }
    locked_.clear(std::memory_order_release);
    if (its_turn) turn_.notify_all();
  }

  // Spins for about 20 us before it sleeps: waking a thread takes more.
  void wait_for_other(std::uint32_t turn) const {
    constexpr int kSpins = 2000;
    for (int i = 0; i < kSpins; ++i) {
      if (turn_.load(std::memory_order_acquire) != turn) return;
      hwy::Pause();
    }
    turn_.wait(turn, std::memory_order_acquire);
  }

  std::size_t total_ = 0;
  bool with_unsnapped_ = false;
  std::vector<Slot> slots_;             // kBuffers per worker
  std::atomic_flag locked_;             // held by finish(), for a few stores; WASI has no std::mutex
  std::atomic<std::uint32_t> turn_{0};  // the ranges before this one have positions
  std::vector<Slot*> finished_;         // by range; null: unfinished
};

}  // namespace edgewise
