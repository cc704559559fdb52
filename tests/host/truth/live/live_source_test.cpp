#include "host/truth/live/live_source.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <deque>
#include <memory>

#include "host/base/error.hpp"

namespace astro::truth {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A tracker in virtual time, which passes while the source waits: 100 poses per second, 5 ms late.
struct Lab {
  microseconds now{1'000'000'000};
  microseconds next{now};
  bool sends = true;
  microseconds senders_zero{5'000'000};  // of its clock, in ours
  std::vector<std::string> bodies{"ASTRO"};
  std::string why = "it sleeps";
  int connections = 1;
  double across_m = 2, height_m = 0.2, across_mps = 0, rise_mps = 0;
  std::vector<Sighting> sightings;

  void pass(microseconds time) {
    now += time;
    for (; next + milliseconds(5) <= now; next += milliseconds(10)) {
      if (!sends) continue;
      const double x_m = 1e-6 * static_cast<double>(next.count());
      across_m += 0.01 * across_mps;
      height_m += 0.01 * rise_mps;
      sightings.push_back(
          {{(next - senders_zero).count(), now.count()}, {x_m, across_m, height_m, 0, 0, 0, 1}});
    }
  }
};

class LabLink : public TrackerLink {
 public:
  explicit LabLink(Lab& lab) : lab_(lab) {}
  void work(microseconds) override {}
  void wait(microseconds timeout) override { lab_.pass(timeout); }
  std::vector<Sighting> take() override { return std::exchange(lab_.sightings, {}); }
  std::string why_silent() const override { return lab_.why; }
  std::vector<std::string> bodies() const override { return lab_.bodies; }
  const std::string& body() const override { return lab_.bodies.front(); }
  std::string way() const override { return "by magic"; }
  int connections() const override { return lab_.connections; }

 private:
  Lab& lab_;
};

std::unique_ptr<LiveSource> open(Lab& lab, std::string_view url = "vrpn://lab/ASTRO") {
  return std::make_unique<LiveSource>(tracker_url_in(url), std::make_unique<LabLink>(lab),
                                      [&] { return lab.now; });
}

template <class Work>
std::string complaint(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(LiveSource, GivesEachPoseOnceAtTheTimeOfItsExposure) {
  Lab lab;
  const auto source = open(lab);
  std::vector<recording::TruthSample> samples = source->poll();
  EXPECT_GT(samples.size(), 60U) << "those by which the clock was chosen";
  for (int i = 0; i < 10; ++i) {
    lab.pass(milliseconds(33));
    for (const auto& sample : source->poll()) samples.push_back(sample);
  }
  EXPECT_THAT(source->poll(), IsEmpty());
  for (std::size_t i = 1; i < samples.size(); ++i)
    EXPECT_EQ(samples[i].time_us - samples[i - 1].time_us, 10'000) << i;
  // x is the time of the exposure. The shortest of the delays, of at least 5 ms, is taken for none.
  for (const auto& sample : samples) {
    EXPECT_TRUE(sample.valid);
    EXPECT_GE(static_cast<double>(sample.time_us) - 1e6 * sample.x_m, 5'000 - 1);
    EXPECT_LE(static_cast<double>(sample.time_us) - 1e6 * sample.x_m, 15'000 + 1);
  }
}

TEST(LiveSource, SaysWhatItFound) {
  Lab lab;
  EXPECT_THAT(
      open(lab)->description(),
      testing::StartsWith("'ASTRO' from lab by magic, 100.0 poses per second, times by the tracker's clock "
                          "(jitter 0.00 ms, of arrival "));
}

TEST(LiveSource, WithoutPosesItSaysWhyWithinSixSeconds) {
  Lab lab;
  lab.sends = false;
  const microseconds begin = lab.now;
  EXPECT_EQ(complaint([&] { open(lab); }), "no ground truth comes from lab: it sleeps");
  EXPECT_LE(lab.now - begin, milliseconds(6'100));
}

TEST(LiveSource, OfSeveralBodiesOneHasToBeNamed) {
  Lab lab;
  lab.bodies = {"ASTRO", "TABLE"};
  EXPECT_EQ(complaint([&] { open(lab, "vrpn://lab"); }),
            "lab tracks several bodies, and none was named: 'ASTRO', 'TABLE'");
  EXPECT_EQ(complaint([&] { open(lab, "vrpn://lab/ASTRO"); }), "");
}

TEST(LiveSource, AShortSilenceIsAGapAndALongOneAnError) {
  Lab lab;
  const auto source = open(lab);
  lab.sends = false;
  source->poll();
  const auto listen = [&](microseconds time) {
    std::size_t came = 0;
    for (const microseconds end = lab.now + time; lab.now < end; lab.pass(milliseconds(50)))
      came += source->poll().size();
    return came;
  };
  EXPECT_EQ(listen(milliseconds(9'800)), 0U);
  lab.sends = true;
  EXPECT_GT(listen(milliseconds(200)), 10U);
  lab.sends = false;
  EXPECT_EQ(complaint([&] { listen(milliseconds(11'000)); }),
            "no ground truth has come from lab for 10 s: it sleeps");
  lab.why = "";  // as a link says that has passed on poses
  EXPECT_EQ(complaint([&] { listen(milliseconds(11'000)); }),
            "no ground truth has come from lab for 10 s: it has stopped sending");
}

TEST(LiveSource, WhileNobodyPollsNothingIsMissed) {
  Lab lab;
  const auto source = open(lab);
  source->poll();
  lab.sends = false;
  lab.pass(std::chrono::minutes(10));  // a person is asked something, and the tracker has let the client go
  EXPECT_THAT(source->poll(), IsEmpty());
  lab.sends = true;
  lab.pass(milliseconds(100));
  EXPECT_THAT(source->poll(), SizeIs(10));
}

TEST(LiveSource, ATrackerThatRestartedWithAnotherClockGoesOnInTime) {
  Lab lab;
  const auto source = open(lab);
  const std::int64_t last_us = source->poll().back().time_us;
  lab.senders_zero += seconds(3);  // less than a slow network could hold samples back
  ++lab.connections;
  lab.pass(milliseconds(20));
  const auto samples = source->poll();
  ASSERT_THAT(samples, testing::Not(IsEmpty()));
  // The first of the new stamps is taken for one without delay, and it is at most 20 ms old.
  EXPECT_NEAR(static_cast<double>(samples.front().time_us - last_us), 10'000, 20'000);
}

TEST(LiveSource, TheUpAxisIsThatOfTheAddress) {
  Lab lab;
  EXPECT_EQ(open(lab, "vrpn://lab/ASTRO?up=z")->poll().front().y_m, 2);
  EXPECT_EQ(open(lab, "vrpn://lab/ASTRO?up=y")->poll().front().y_m, -0.2);
}

/// What the source says while the body moves for so many seconds.
std::string said_in(Lab& lab, LiveSource& source, double span_s) {
  return complaint([&] {
    for (const microseconds end = lab.now + microseconds(std::llround(1e6 * span_s)); lab.now < end;) {
      lab.pass(milliseconds(50));
      source.poll();
    }
  });
}

TEST(LiveSource, ADriveUpTheAxisThatIsTakenForUpEndsAtOnce) {
  for (const std::string up : {"z", "y"}) {
    Lab lab;
    const auto source = open(lab, "vrpn://lab/ASTRO?up=" + up);
    source->poll();
    (up == "z" ? lab.rise_mps : lab.across_mps) = -0.3;
    EXPECT_EQ(said_in(lab, *source, 0.9), "");
    EXPECT_THAT(said_in(lab, *source, 1),
                HasSubstr("along the tracker's " + up + " axis, which is taken for up"));
  }
}

TEST(LiveSource, ARobotThatClimbsARampOrIsCarriedBetweenDrivesMayRise) {
  Lab lab;
  const auto source = open(lab);
  lab.rise_mps = 0.1;
  lab.across_mps = 0.3;
  EXPECT_EQ(said_in(lab, *source, 10), "") << "a ramp";
  lab.across_mps = 0;
  lab.rise_mps = 0.5;
  EXPECT_EQ(said_in(lab, *source, 3), "") << "picked up after a drive";
  lab.pass(seconds(3));  // nobody polls
  lab.rise_mps = 0;
  EXPECT_EQ(said_in(lab, *source, 10), "") << "put down elsewhere";
}

}  // namespace
}  // namespace astro::truth
