#include <gtest/gtest.h>

#include <memory>

#include "host/experiment/drive/record_run.hpp"
#include "tests/support/robots/desk.hpp"

// Ground truth that is stamped by the recording computer's clock.
namespace astro::experiment {
namespace {

using namespace std::chrono_literals;

constexpr microseconds kAhead = 3h;  // of the computer's clock

class ComputersTransport : public simulation::InProcessTransport {
 public:
  using InProcessTransport::InProcessTransport;
  microseconds now() const override { return InProcessTransport::now() + kAhead; }
};

class ComputersTruth : public truth::Source {
 public:
  explicit ComputersTruth(std::shared_ptr<simulation::VirtualRobot> robot) : cameras_(std::move(robot)) {}
  std::vector<recording::TruthSample> poll() override {
    auto samples = cameras_.poll();
    for (auto& sample : samples) sample.time_us += kAhead.count();
    return samples;
  }
  std::string name() const override { return "vrpn"; }
  std::string clock() const override { return "host"; }

 private:
  simulation::CameraTruth cameras_;
};

TEST(TruthOnTheHostsClock, IsRecordedOnTheRobotsWithAnOffsetThatStays) {
  const auto robot = std::make_shared<simulation::VirtualRobot>(sim::Config{}, simulation::MocapConfig{});
  robot::Client client(std::make_unique<ComputersTransport>(robot));
  client.connect();
  ComputersTruth truth(robot);
  std::vector<recording::TruthSample> samples;
  std::int64_t first_us = 0, last_us = 0;
  const Recorded recorded =
      record_until(client, truth,
                   {[&](const recording::OdometrySample& sample) {
                      if (first_us == 0) first_us = sample.time_us;
                      last_us = sample.time_us;
                    },
                    [&](const recording::TruthSample& sample) { samples.push_back(sample); }},
                   [&] { return last_us - first_us > 30'000'000; });
  ASSERT_GT(recorded.truth, 1'700U) << "60 in each of 30 seconds";
  // The cameras expose every 16.667 ms of the robot's clock, rounded up to its milliseconds, from its start on.
  std::int64_t least_us = 1'000'000, most_us = -1'000'000;
  for (const auto& sample : samples) {
    EXPECT_GE(sample.time_us, first_us);
    EXPECT_LE(sample.time_us, last_us);
    const double period_us = 1e6 / 60;
    const double exposed_us = std::round(static_cast<double>(sample.time_us) / period_us) * period_us;
    const auto off_us = std::llround(static_cast<double>(sample.time_us) - exposed_us);
    least_us = std::min<std::int64_t>(least_us, off_us);
    most_us = std::max<std::int64_t>(most_us, off_us);
  }
  EXPECT_LE(most_us - least_us, 1'000) << "no more than the rounding: the offset stays";
  EXPECT_GE(least_us, -3'000) << "half a round trip";
  EXPECT_LE(most_us, 4'000);
}

}  // namespace
}  // namespace astro::experiment
