#include "cli/soak/campaign.h"

#include <fmt/format.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <vector>

#include "cli/soak/evidence.h"
#include "support/process.h"

namespace edgewise::soak {

namespace {

using Clock = std::chrono::steady_clock;

struct Done {
  Tally tally;
  std::vector<nlohmann::json> findings;
};

class Soak {
 public:
  Soak(const Campaign& campaign, Record record)
      : campaign_(campaign),
        record_(std::move(record)),
        seconds_before_(record_.seconds),
        next_(record_.shards.front().cases),
        end_(campaign.cases ? next_ + *campaign.cases : std::numeric_limits<std::uint64_t>::max()) {}

  Record run() {
    std::vector<std::thread> threads;
    start(threads);
    watch();
    for (std::thread& thread : threads) thread.join();
    if (failure_) give_up();
    campaign_.on_progress(record_);
    return std::move(record_);
  }

 private:
  // If a thread fails to start, keeps the error: run() joins the started threads before it reports the error.
  void start(std::vector<std::thread>& threads) {
    try {
      for (int i = 0; i < campaign_.jobs; ++i) {
        const std::lock_guard lock(mutex_);
        threads.emplace_back([this] { work(); });
        ++working_;
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
  }

  // Saves the record and throws failure_; a failure to save is ignored in its favour.
  [[noreturn]] void give_up() {
    try {
      campaign_.on_failure(record_);
    } catch (const std::exception&) {
    }
    std::rethrow_exception(failure_);
  }

  // One thread: draws cases until none is left.
  void work() {
    try {
      Checker checker(campaign_.judged);
      while (const auto k = take()) add(*k, check(checker, shard_.number(*k)));
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    --working_;
    thread_ended_.notify_one();
  }

  void watch() {
    constexpr auto kPause = std::chrono::milliseconds(200);
    std::unique_lock lock(mutex_);
    while (!thread_ended_.wait_for(lock, kPause, [&] { return working_ == 0; })) {
      const Record now = record_;
      lock.unlock();
      try {
        campaign_.on_progress(now);
      } catch (...) {
        lock.lock();
        if (!failure_) failure_ = std::current_exception();
        continue;
      }
      lock.lock();
    }
  }

  std::optional<std::uint64_t> take() {
    const std::lock_guard lock(mutex_);
    if (failure_ || next_ >= end_ || must_end()) return std::nullopt;
    return next_++;
  }

  bool must_end() const {
    return (campaign_.seconds && seconds_here() >= *campaign_.seconds) || campaign_.stop();
  }

  Done check(Checker& checker, std::uint64_t number) {
    const Case c = make_case(seed_, number);
    try {
      Verdict verdict = checker.check(c);
      Done done{std::move(verdict.tally), {}};
      for (const Finding& finding : verdict.findings)
        if (found_++ < kMostFindings)
          done.findings.push_back(evidence_of(evidence_, seed_, c, finding, checker));
      return done;
    } catch (const std::exception& error) {
      throw std::runtime_error(
          fmt::format("seed {}, case {} ({}): {}", seed_, number, c.family, tools::reason_of(error)));
    }
  }

  // Cases end in any order, but enter the record in the order of the sequence.
  void add(std::uint64_t k, Done done) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(k, std::move(done));
    Shard& shard = record_.shards.front();
    for (auto first = waiting_.begin(); first != waiting_.end() && first->first == shard.cases;
         first = waiting_.erase(first)) {
      ++shard.cases;
      record_.tally += first->second.tally;
      for (nlohmann::json& finding : first->second.findings)
        if (record_.findings.size() < kMostFindings) record_.findings.push_back(std::move(finding));
    }
    record_.seconds = seconds_before_ + seconds_here();
  }

  double seconds_here() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const Campaign& campaign_;
  const Clock::time_point start_ = Clock::now();
  const Evidence evidence_{campaign_.program, campaign_.failure_folder, [this] { return must_end(); }};
  std::mutex mutex_;  // guards all non-const members below but the atomic one
  std::condition_variable thread_ended_;
  Record record_;
  const double seconds_before_;
  std::atomic<std::size_t> found_ = record_.findings.size();
  const std::uint64_t seed_ = record_.seed;
  const Shard shard_ = record_.shards.front();
  std::uint64_t next_;
  const std::uint64_t end_;
  std::map<std::uint64_t, Done> waiting_;
  int working_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

Record run(const Campaign& campaign, Record record) {
  return Soak(campaign, std::move(record)).run();
}

}  // namespace edgewise::soak
