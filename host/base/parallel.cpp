#include "host/base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "host/base/blocked_signals.hpp"

namespace astro {
namespace {

constexpr int kMostThreads = 8;  // each piece may take much memory, and most work is shared among few pieces
constexpr auto kPollPeriod = std::chrono::milliseconds(100);

/// Whether this thread does a piece of shared work. A piece that shared its own work out would only add threads to processors
/// that are busy already.
thread_local bool does_a_piece = false;

class Pool {
 public:
  Pool(int count, const std::function<void(int)>& work) : count_(count), work_(work) {}

  void serve() {
    const bool before = std::exchange(does_a_piece, true);
    // A number that was taken is done, so that of several failures the lowest is always among those that were seen.
    while (!stopped_) {
      const int i = next_++;
      if (i >= count_) break;
      try {
        work_(i);
        ++done_;
      } catch (...) {
        stop(i, std::current_exception());
      }
    }
    does_a_piece = before;
    const std::lock_guard lock(mutex_);
    ++served_;
    changed_.notify_all();
  }

  void watch(int threads, const std::function<void(int)>& meanwhile) {
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, kPollPeriod, [&] { return served_ == threads; })) {
      lock.unlock();
      meanwhile(done_);
      lock.lock();
    }
  }

  void stop(int piece, std::exception_ptr reason) {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    if (reason_ && piece_ < piece) return;
    reason_ = std::move(reason);
    piece_ = piece;
  }

  void rethrow() const {
    if (reason_) std::rethrow_exception(reason_);
  }

 private:
  const int count_;
  const std::function<void(int)>& work_;
  std::atomic<int> next_ = 0, done_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::exception_ptr reason_;
  int piece_ = 0;  // that threw it; below 0: none
  int served_ = 0;
};

/// Joins its threads. Where the system gives fewer than wanted, those that there are do the work; where it gives none, the
/// caller does.
class Threads {
 public:
  Threads(Pool& pool, int wanted) {
    const BlockedSignals blocked;
    try {
      for (int i = 0; i < wanted; ++i) threads_.emplace_back([&pool] { pool.serve(); });
    } catch (const std::system_error&) {
    }
  }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  ~Threads() {
    for (std::thread& thread : threads_) thread.join();
  }

  int count() const { return static_cast<int>(threads_.size()); }

 private:
  std::vector<std::thread> threads_;
};

}  // namespace

void in_parallel(int count, const std::function<void(int)>& work) {
  Pool pool(count, work);
  {
    const int processors = static_cast<int>(std::thread::hardware_concurrency());
    const Threads others(pool, does_a_piece ? 0 : std::min({processors, count, kMostThreads}) - 1);
    pool.serve();
  }
  pool.rethrow();
}

void in_parallel(int count, int jobs, const std::function<void(int)>& work,
                 const std::function<void(int done)>& meanwhile) {
  Pool pool(count, work);
  {
    const Threads threads(pool, std::clamp(jobs, 1, std::max(count, 1)));
    if (threads.count() == 0) pool.serve();
    try {
      pool.watch(std::max(threads.count(), 1), meanwhile);
    } catch (...) {
      pool.stop(-1, std::current_exception());
    }
  }
  pool.rethrow();
  meanwhile(count);
}

}  // namespace astro
