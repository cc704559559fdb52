#include "host/simulation/server/pace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

// A server's loop in virtual time: it asks its pace, steps or waits, and is delayed as a test says.
namespace astro::simulation {
namespace {

using namespace std::chrono_literals;

class Loop {
 public:
  /// `late`: how much later than requested the loop runs again, each time.
  explicit Loop(std::function<Pace::Duration()> late) : late_(std::move(late)) {}

  void run_for(Pace::Duration time) {
    const Pace::Time end = now_ + time;
    while (now_ < end) look();
  }
  void pause(Pace::Duration time) { now_ += time; }
  /// Real time between two requests of the host, each of which is answered by an early step if that is
  /// allowed.
  void speak_every(Pace::Duration time) { words_ = time; }

  Pace::Duration virtual_time() const { return steps_ * Pace::kStep; }
  Pace::Duration real_time() const { return now_ - Pace::Time{}; }
  Pace::Duration ahead() const { return virtual_time() - real_time(); }
  Pace::Duration furthest_ahead() const { return furthest_; }

 private:
  void step() {
    pace_.stepped();
    ++steps_;
    furthest_ = std::max(furthest_, ahead());
  }
  void look() {
    constexpr Pace::Duration kOfALook = 20us;
    if (words_ != 0ms && now_ >= spoken_ + words_) {
      spoken_ = now_;
      if (pace_.may_step_early(now_)) step();
    }
    if (pace_.due(now_))
      step();
    else
      now_ = std::max(now_, pace_.next()) + late_();
    now_ += kOfALook;
  }

  Pace::Time now_{}, spoken_{};
  Pace pace_{now_};
  std::function<Pace::Duration()> late_;
  Pace::Duration words_{}, furthest_{};
  long steps_ = 0;
};

Pace::Duration never() { return 0ms; }

TEST(Pace, KeepsRealTimeWhereNothingElseRuns) {
  Loop loop(never);
  loop.run_for(60s);
  EXPECT_LE(loop.ahead(), Pace::kStep);
  EXPECT_GE(loop.ahead(), -Pace::kStep);
}

TEST(Pace, IsNotMadeFastByAHostThatSpeaks) {
  for (const Pace::Duration every : {50ms, 10ms, 3ms, 1ms}) {
    Loop loop(never);
    loop.speak_every(every);
    loop.run_for(60s);
    EXPECT_LE(loop.furthest_ahead(), 2 * Pace::kStep) << every.count() << " ns between two words";
    EXPECT_GE(loop.ahead(), -Pace::kStep);
  }
}

TEST(Pace, KeepsRealTimeOnABusyComputer) {
  constexpr unsigned kSeed = 1;
  std::mt19937 random(kSeed);
  // A scheduler's slices: 4 ms each, up to five other programs in turn, now and then 100 ms.
  Loop loop([&random]() -> Pace::Duration {
    const auto dice = static_cast<int>(random() % 100);
    return dice == 0 ? 100ms : dice < 50 ? 4ms * static_cast<int>(random() % 6) : 0ms;
  });
  loop.speak_every(50ms);
  loop.run_for(60s);
  EXPECT_LE(loop.furthest_ahead(), 2 * Pace::kStep) << "seed " << kSeed;
  EXPECT_GE(loop.ahead(), -120ms) << "but for the slice that it is in; seed " << kSeed;
}

TEST(Pace, MakesUpForAPauseAtTwiceRealTimeAtMost) {
  Loop loop(never);
  loop.run_for(1s);
  loop.pause(1s);
  const Pace::Duration before = loop.virtual_time();
  loop.run_for(100ms);
  EXPECT_LE(loop.virtual_time() - before, 2 * 100ms + 20ms) << "twice, and the burst of 20 ms";
  EXPECT_GE(loop.virtual_time() - before, 190ms);
  loop.run_for(1s);
  EXPECT_GE(loop.ahead(), -Pace::kStep) << "all of it";
}

TEST(Pace, BeginsAnewAfterThePauseOfAComputerThatSlept) {
  Loop loop(never);
  loop.run_for(1s);
  loop.pause(2100ms);
  loop.run_for(1s);
  EXPECT_LE(loop.virtual_time(), 2s + 2 * Pace::kStep);
  EXPECT_GE(loop.virtual_time(), 2s - 2 * Pace::kStep);
}

}  // namespace
}  // namespace astro::simulation
