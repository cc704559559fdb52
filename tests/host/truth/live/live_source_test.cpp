#include "host/truth/live/live_source.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include "host/base/error.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::truth {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using support::Tells;
using support::ThrowsTelling;
using support::told_by;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A tracker in virtual time, which passes while the source waits: 100 poses per second, 5 ms late.
struct Lab {
  microseconds now{1'000'000'000};
  microseconds next{now};
  bool sends = true, seen = true;
  microseconds senders_zero{5'000'000};  // of its clock, in ours
  double senders_drift = 0;              // of its clock against ours
  std::int64_t senders_tick_us = 1;      // its clock shows whole ticks
  bool stamped_at_once = false;          // otherwise poses arrive when somebody looks
  std::int64_t delayed_us = 0;           // of every third pose, by a busy network
  std::vector<std::string> bodies{"ASTRO"};
  std::string why = "it sleeps";
  int connections = 1;
  double across_m = 2, height_m = 0.2, across_mps = 0, rise_mps = 0;
  microseconds period = milliseconds(10);
  std::vector<Sighting> sightings;

  void pass(microseconds time) {
    now += time;
    for (; next + milliseconds(5) <= now; next += period) {
      if (!sends) continue;
      const double x_m = 1e-6 * static_cast<double>(next.count());
      across_m += 0.01 * across_mps;
      height_m += 0.01 * rise_mps;
      sightings.push_back(
          {{senders_us(), arrival_us()}, {seen ? x_m : 0, across_m, height_m, 0, 0, 0, seen ? 1.0 : 0.0}});
    }
  }
  std::int64_t senders_us() const {
    return std::llround((1 + senders_drift) * static_cast<double>((next - senders_zero).count())) /
           senders_tick_us * senders_tick_us;
  }
  std::int64_t arrival_us() const {
    if (!stamped_at_once) return now.count();
    return next.count() + 5'000 + (next.count() / 10'000 % 3 == 0 ? delayed_us : 0);
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
  EXPECT_THAT([&] { open(lab); }, ThrowsTelling(LiveProblem::tracker_silent, "lab", "it sleeps"));
  EXPECT_LE(lab.now - begin, milliseconds(6'100));
}

TEST(LiveSource, RefusesMorePosesPerSecondThanAnyTrackerMeasures) {
  Lab lab;
  const auto source = open(lab);
  lab.period = microseconds(10);
  std::size_t came = 0;
  const auto drive = [&] {
    for (int i = 0; i < 1000; ++i) {
      lab.pass(milliseconds(50));
      came += source->poll().size();
    }
  };
  EXPECT_THAT(drive, ThrowsTelling(LiveProblem::too_many_poses, "lab", "10000"));
  EXPECT_LE(came, 120'000U);
}

TEST(LiveSource, TakesWhatCameWhileTheProgramWasStopped) {
  Lab lab;
  const auto source = open(lab);
  lab.period = milliseconds(1);
  lab.pass(seconds(60));
  EXPECT_GE(source->poll().size(), 60'000U);
}

TEST(LiveSource, WaitsInBoundedMemoryForABodyThatIsNotSeen) {
  const auto taken = support::measured([] {
    Lab lab;
    const auto source = open(lab);
    lab.period = microseconds(10);
    lab.seen = false;
    EXPECT_THAT([&] { source->begin_run(); }, ThrowsTelling(LiveProblem::body_unseen, "lab", "ASTRO"));
  });
  EXPECT_TRUE(taken.ended);
  if (support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, std::size_t{16} << 20);
  }
}

TEST(LiveSource, OfSeveralBodiesOneHasToBeNamed) {
  Lab lab;
  lab.bodies = {"ASTRO", "TABLE"};
  EXPECT_THAT([&] { open(lab, "vrpn://lab"); },
              ThrowsTelling(LiveProblem::several_bodies, "lab", "ASTRO", "TABLE"));
  EXPECT_NO_THROW(open(lab, "vrpn://lab/ASTRO"));
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
  const auto wait = [&] { listen(milliseconds(11'000)); };
  EXPECT_THAT(wait, ThrowsTelling(LiveProblem::tracker_silent, "lab", "it sleeps", "10"));
  lab.why = "";  // as a link says that has passed on poses
  EXPECT_THAT(wait, ThrowsTelling(LiveProblem::poses_ended, "lab", "ASTRO", "10"));
}

TEST(LiveSource, ARunBeginsOnceTheBodyIsSeenNowAndWithoutTheSamplesFromBefore) {
  Lab lab;
  const auto source = open(lab);
  lab.pass(std::chrono::minutes(10));  // a person is asked something
  const microseconds begin = lab.now;
  source->begin_run();
  EXPECT_LE(lab.now - begin, seconds(1));
  const auto samples = source->poll();
  ASSERT_THAT(samples, testing::Not(IsEmpty()));
  EXPECT_GE(1e6 * samples.front().x_m, static_cast<double>((begin - milliseconds(20)).count()));
  lab.pass(milliseconds(100));
  EXPECT_THAT(source->poll(), SizeIs(10));
}

TEST(LiveSource, NoRunBeginsWhileNoTruthComes) {
  Lab lab;
  const auto source = open(lab);
  const auto refusal = [&] {
    const microseconds begin = lab.now;
    const Remark why = told_by([&] { source->begin_run(); });
    EXPECT_LE(lab.now - begin, milliseconds(7'000));
    return why;
  };
  lab.pass(seconds(2));  // these poses are not from now
  lab.sends = false;
  EXPECT_THAT(refusal(), Tells(LiveProblem::tracker_silent, "lab", "it sleeps"));
  lab.why = "";  // as of a link that has had poses
  EXPECT_THAT(refusal(), Tells(LiveProblem::poses_ended, "lab", "ASTRO"));
  lab.sends = true;
  lab.seen = false;
  EXPECT_THAT(refusal(), Tells(LiveProblem::body_unseen, "lab", "ASTRO"));
  lab.seen = true;
  EXPECT_EQ(refusal().sentence, "");
}

/// The samples of so long, polled as a drive polls.
std::vector<recording::TruthSample> polled_for(Lab& lab, LiveSource& source, microseconds time) {
  std::vector<recording::TruthSample> samples;
  for (const microseconds end = lab.now + time; lab.now < end;) {
    lab.pass(milliseconds(50));
    for (const auto& sample : source.poll()) samples.push_back(sample);
  }
  return samples;
}

/// How far the first and the last of samples are late.
std::pair<double, double> lateness_us(const std::vector<recording::TruthSample>& samples) {
  const auto late_us = [](const auto& sample) {
    return static_cast<double>(sample.time_us) - 1e6 * sample.x_m;
  };
  return {late_us(samples.front()), late_us(samples.back())};
}

TEST(LiveSource, WithinARunTheTimesOfATrackerWhoseClockDriftsNeverStep) {
  for (const double drift : {-100e-6, 100e-6}) {
    Lab lab;
    lab.senders_drift = drift;
    const auto source = open(lab);
    source->begin_run();
    const auto samples = polled_for(lab, *source, std::chrono::minutes(40));
    ASSERT_GT(samples.size(), 239'900U);
    for (std::size_t i = 1; i < samples.size(); ++i)
      ASSERT_NEAR(static_cast<double>(samples[i].time_us - samples[i - 1].time_us), 10'000, 2) << i;
    source->begin_run();
    lab.pass(milliseconds(50));
    EXPECT_NEAR(lateness_us(source->poll()).first, 10'000, 11'000) << "the next run forgets the drift";
  }
}

TEST(LiveSource, ATrackerThatConnectsAgainGoesOnInTimeByTheSameClockOrAnother) {
  for (const microseconds jump : {seconds(0), seconds(3), seconds(-3), seconds(-3'600), seconds(3'600)}) {
    Lab lab;
    const auto source = open(lab);
    source->begin_run();
    const auto before = polled_for(lab, *source, seconds(3));
    lab.senders_zero += jump;
    ++lab.connections;
    const auto after = polled_for(lab, *source, seconds(3));
    ASSERT_GT(after.size(), 290U) << "none is lost";
    EXPECT_GE(after.front().time_us, before.back().time_us);
    const double most_us =
        jump == seconds(0) ? 1 : 10'001;  // the shortest delay of batches is known to a period
    EXPECT_NEAR(lateness_us(after).first, lateness_us(before).second, most_us) << jump.count();
    EXPECT_NEAR(lateness_us(after).first, lateness_us(after).second, 1) << jump.count();
  }
}

TEST(LiveSource, ATrackerWhoseClockIsSetDuringARunGoesOnInTime) {
  for (const microseconds jump : {seconds(3), seconds(-3)}) {
    Lab lab;
    const auto source = open(lab);
    source->begin_run();
    const auto before = polled_for(lab, *source, seconds(3));
    lab.senders_zero += jump;
    const auto after = polled_for(lab, *source, seconds(3));
    ASSERT_GT(after.size(), 290U);
    EXPECT_NEAR(lateness_us(after).first, lateness_us(before).second, 10'001) << jump.count();
    EXPECT_NEAR(lateness_us(after).first, lateness_us(after).second, 1) << jump.count();
  }
}

TEST(LiveSource, EachRunChoosesItsTimesByWhatTheLastDriveWasLike) {
  Lab lab;
  lab.senders_tick_us = 4'000;
  lab.stamped_at_once = true;
  const auto source = open(lab);
  EXPECT_THAT(source->description(), HasSubstr("times of arrival (jitter 0.00 ms"));
  source->begin_run();
  const auto calm = polled_for(lab, *source, seconds(3));
  for (std::size_t i = 1; i < calm.size(); ++i) EXPECT_EQ(calm[i].time_us - calm[i - 1].time_us, 10'000);
  lab.delayed_us = 9'000;
  const auto are_ticks = [&](const std::vector<recording::TruthSample>& samples) {
    for (std::size_t i = 1; i < samples.size(); ++i)
      if ((samples[i].time_us - samples[i - 1].time_us) % lab.senders_tick_us != 0) return false;
    return true;
  };
  EXPECT_FALSE(are_ticks(polled_for(lab, *source, seconds(3)))) << "within a run the choice stays";
  source->begin_run();
  source->poll();
  EXPECT_TRUE(are_ticks(polled_for(lab, *source, seconds(3))));
}

TEST(LiveSource, OfPosesThatOvertakeEachOtherTheLateOnesAreLeftOut) {
  Lab lab;
  const auto source = open(lab);
  source->begin_run();
  source->poll();
  lab.pass(milliseconds(50));
  std::swap(lab.sightings[1], lab.sightings[2]);
  const auto samples = source->poll();
  ASSERT_THAT(samples, SizeIs(4));
  for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_GT(samples[i].time_us, samples[i - 1].time_us);
}

TEST(LiveSource, TheUpAxisIsThatOfTheAddress) {
  Lab lab;
  EXPECT_EQ(open(lab, "vrpn://lab/ASTRO?up=z")->poll().front().y_m, 2);
  EXPECT_EQ(open(lab, "vrpn://lab/ASTRO?up=y")->poll().front().y_m, -0.2);
}

/// What the source tells while the body moves for so many seconds.
Remark told_in(Lab& lab, LiveSource& source, double span_s) {
  return told_by([&] {
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
    EXPECT_EQ(told_in(lab, *source, 0.9).sentence, "");
    EXPECT_THAT(told_in(lab, *source, 1),
                Tells(UpAxisProblem::contradicted, up, up == "z" ? "y" : "z", testing::StartsWith("-0.")));
  }
}

TEST(LiveSource, ARobotThatClimbsARampOrIsCarriedBetweenDrivesMayRise) {
  Lab lab;
  const auto source = open(lab);
  lab.rise_mps = 0.1;
  lab.across_mps = 0.3;
  EXPECT_EQ(told_in(lab, *source, 10).sentence, "") << "a ramp";
  lab.across_mps = 0;
  lab.rise_mps = 0.5;
  EXPECT_EQ(told_in(lab, *source, 3).sentence, "") << "picked up after a drive";
  lab.pass(seconds(3));  // nobody polls
  lab.rise_mps = 0;
  source->begin_run();
  EXPECT_EQ(told_in(lab, *source, 10).sentence, "") << "put down elsewhere";
}

}  // namespace
}  // namespace astro::truth
