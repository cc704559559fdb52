#include "host/simulation/study/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace astro::simulation::study {
namespace {

constexpr auto kPollPeriod = std::chrono::milliseconds(100);

class Pool {
 public:
  Pool(int count, const std::function<void(int)>& work) : count_(count), work_(work) {}

  void serve() {
    try {
      for (int i = next_++; i < count_ && !stopped_; i = next_++) {
        work_(i);
        ++done_;
      }
    } catch (...) {
      stop(std::current_exception());
    }
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

  void stop(std::exception_ptr reason) {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    if (!reason_) reason_ = std::move(reason);
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
  int served_ = 0;
};

}  // namespace

void in_parallel(int count, int jobs, const std::function<void(int)>& work,
                 const std::function<void(int done)>& meanwhile) {
  Pool pool(count, work);
  {
    std::vector<std::jthread> threads;
    const int wanted = std::clamp(jobs, 1, std::max(count, 1));
    for (int i = 0; i < wanted; ++i) threads.emplace_back([&pool] { pool.serve(); });
    try {
      pool.watch(wanted, meanwhile);
    } catch (...) {
      pool.stop(std::current_exception());
    }
  }
  pool.rethrow();
  meanwhile(count);
}

}  // namespace astro::simulation::study
