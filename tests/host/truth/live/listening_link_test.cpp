#include "host/truth/live/listening_link.hpp"

#include <gmock/gmock.h>

#include <chrono>

#include "host/base/error.hpp"

// The clock is virtual; the thread is real, and each claim waits for what it has done.
namespace astro::truth {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using testing::Each;
using testing::ElementsAre;
using testing::SizeIs;

/// A tracker and the clock beside it. What is sent has been read, with the time of then, when send() returns.
class Line {
 public:
  microseconds now() {
    const std::lock_guard lock(mutex_);
    return now_;
  }
  void set(microseconds now) {
    change([&] { now_ = now; });
  }
  void send(int poses = 1) {
    change([&] { sent_ = poses; });
  }
  void connect_again() {
    change([&] { ++connections_; });
  }
  void fail() {
    change([&] { fails_ = true; });
  }

  void work(microseconds now) {
    const std::lock_guard lock(mutex_);
    if (fails_) throw Error("it is broken");
    for (; sent_ > 0; --sent_) sightings_.push_back({{0, now.count()}, {}, true});
  }
  std::vector<Sighting> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(sightings_, {});
  }
  int connections() {
    const std::lock_guard lock(mutex_);
    return connections_;
  }
  /// A turn of whoever works the line has ended.
  void end_turn() {
    std::unique_lock lock(mutex_);
    ++turns_;
    changed_.notify_all();
    changed_.wait_for(lock, milliseconds(1));
  }

 private:
  /// Returns after a turn that began after the change has ended, or has failed.
  template <class Change>
  void change(Change change) {
    std::unique_lock lock(mutex_);
    change();
    changed_.notify_all();
    changed_.wait(lock, [this, from = turns_] { return fails_ || turns_ >= from + 2; });
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  microseconds now_{0};
  int sent_ = 0, connections_ = 1, turns_ = 0;
  bool fails_ = false;
  std::vector<Sighting> sightings_;
};

class LineLink : public TrackerLink {
 public:
  explicit LineLink(Line& line) : line_(line) {}
  void work(microseconds now) override { line_.work(now); }
  void wait(microseconds) override { line_.end_turn(); }
  std::vector<Sighting> take() override { return line_.take(); }
  std::string why_silent() const override { return "it sleeps"; }
  std::vector<std::string> bodies() const override { return {"ASTRO"}; }
  const std::string& body() const override { return body_; }
  std::string way() const override { return "by magic"; }
  int connections() const override { return line_.connections(); }

 private:
  Line& line_;
  std::string body_ = "ASTRO";
};

class Listening : public testing::Test {
 protected:
  std::vector<std::int64_t> arrivals_us() {
    std::vector<std::int64_t> times;
    link_.work(line_.now());
    for (const Sighting& sighting : link_.take()) times.push_back(sighting.stamp.arrival_us);
    return times;
  }

  Line line_;
  ListeningLink link_{std::make_unique<LineLink>(line_), [this] { return line_.now(); }};
};

TEST_F(Listening, GivesEachPoseTheTimeAtWhichItCameHoweverLateItIsTaken) {
  for (const int time_ms : {10, 20, 35}) {
    line_.set(milliseconds(time_ms));
    line_.send();
  }
  line_.set(milliseconds(60'000));
  EXPECT_THAT(arrivals_us(), ElementsAre(10'000, 20'000, 35'000));
  EXPECT_THAT(arrivals_us(), SizeIs(0));
}

TEST_F(Listening, TellsWhatTheLinkTells) {
  line_.send();
  link_.work({});
  EXPECT_EQ(link_.why_silent(), "it sleeps");
  EXPECT_EQ(link_.body(), "ASTRO");
  EXPECT_THAT(link_.bodies(), ElementsAre("ASTRO"));
  EXPECT_EQ(link_.way(), "by magic");
  EXPECT_EQ(link_.connections(), 1);
}

TEST_F(Listening, WaitsForTheNextPoseOnly) {
  line_.send();
  link_.wait(std::chrono::minutes(10));
  EXPECT_THAT(arrivals_us(), SizeIs(1));
}

TEST_F(Listening, KeepsTheNewestPosesThatNobodyTakes) {
  for (int second = 1; second <= 20; ++second) {
    line_.set(std::chrono::seconds(second));
    line_.send(1000);
  }
  const auto times_us = arrivals_us();
  EXPECT_THAT(times_us.size(), testing::AllOf(testing::Ge(4'000U), testing::Le(10'000U)));
  EXPECT_EQ(times_us.back(), 20'000'000);
}

TEST_F(Listening, PosesFromBeforeANewConnectionAreOfAnotherClockAndAreNotKept) {
  line_.send();
  line_.set(milliseconds(10));
  line_.connect_again();
  line_.send(2);
  EXPECT_THAT(arrivals_us(), testing::AllOf(SizeIs(2), Each(10'000)));
  EXPECT_EQ(link_.connections(), 2);
}

TEST_F(Listening, AFailureOfTheLinkComesToWhoeverWorksIt) {
  line_.fail();
  link_.wait(std::chrono::minutes(10));
  for (int i = 0; i < 2; ++i) EXPECT_THROW(link_.work({}), Error);
}

}  // namespace
}  // namespace astro::truth
