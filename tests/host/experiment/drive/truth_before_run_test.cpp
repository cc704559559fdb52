#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "host/base/error.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/robots/desk.hpp"

// A drive without its ground truth is lost, and a robot should not drive for nothing.
namespace astro::experiment {
namespace {

using support::Desk;

enum class CameraProblem { none_comes };

/// The desk's cameras, with something that happens before each run.
class WatchedTruth : public truth::Source {
 public:
  WatchedTruth(Desk& desk, std::function<void()> begins) : desk_(desk), begins_(std::move(begins)) {}
  void begin_run() override { begins_(); }
  std::vector<recording::TruthSample> poll() override { return desk_.truth.poll(); }
  std::string name() const override { return "vrpn"; }
  std::string clock() const override { return "robot"; }

 private:
  Desk& desk_;
  std::function<void()> begins_;
};

recording::Run record_line(Desk& desk, truth::Source& truth) {
  return record_run(desk.client, truth, robot::line(0.2), {}, {});
}

protocol::Mode mode_of(Desk& desk) { return desk.client.request(protocol::GetStatus{}).mode; }

TEST(TruthBeforeARun, IsAwaitedWhileTheRobotIsNotArmed) {
  Desk desk{sim::Config{}};
  int begun = 0;
  WatchedTruth truth(desk, [&] {
    ++begun;
    EXPECT_EQ(mode_of(desk), protocol::Mode::disarmed);
  });
  EXPECT_FALSE(record_line(desk, truth).truth.empty());
  record_line(desk, truth);
  EXPECT_EQ(begun, 2) << "once for each run";
}

TEST(TruthBeforeARun, ThatDoesNotComeKeepsTheRobotFromDriving) {
  Desk desk{sim::Config{}};
  bool started = false;
  const auto watch = desk.client.on<protocol::SegmentStarted>([&](const auto&) { started = true; });
  WatchedTruth truth(desk, [] { throw Error("no ground truth comes", CameraProblem::none_comes); });
  EXPECT_THAT([&] { record_line(desk, truth); }, support::ThrowsTelling(CameraProblem::none_comes));
  desk.client.pump(std::chrono::seconds(1));
  EXPECT_FALSE(started);
  EXPECT_EQ(mode_of(desk), protocol::Mode::disarmed);
}

}  // namespace
}  // namespace astro::experiment
