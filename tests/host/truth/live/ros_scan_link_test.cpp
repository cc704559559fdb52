#include "host/truth/live/ros_scan_link.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/cdr/names.hpp"
#include "host/formats/cdr/type_description.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/live/dds/fast_dds.hpp"
#include "host/truth/live/scanner_source.hpp"
#include "tests/support/ros2/domain.hpp"

// A driver of a laser scanner in ROS 2, and our link to it, over loopback.
namespace astro::truth {
namespace {

using ros2::msg::LaserScan;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr auto kLongestWait = std::chrono::seconds(10);  // only a failure waits so long
constexpr double kTurn_s = 0.1;
constexpr int kBeams = 100;

microseconds steady_now() {
  return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
}

/// A node that publishes a scan ten times a second, with stamps since 1970.
class ScannerNode {
 public:
  static constexpr std::int64_t kEpoch_us = 1'790'000'000'000'000;

  ScannerNode()
      : participant_(dds::open_fast_dds({support::test_domain()}, "scanner", "enclave=/;")),
        writer_(participant_->create_writer(
            {"rt/scan", ros2::dds_type_name(LaserScan::kType), dds::Qos{false, false, 10}})) {}

  /// Publishes the scan that has just ended, if one has.
  void work() {
    const microseconds now = steady_now();
    if (now < next_) return;
    next_ = now + std::chrono::duration_cast<microseconds>(std::chrono::duration<double>(kTurn_s));
    LaserScan scan;
    scan.header.stamp =
        ros2::msg::to_time(1000 * (kEpoch_us + now.count() - static_cast<std::int64_t>(1e6 * kTurn_s)));
    scan.angle_min = -1;
    scan.angle_increment = 2.0F / kBeams;
    scan.time_increment = static_cast<float>(kTurn_s / kBeams);
    scan.range_min = 0.1F;
    scan.range_max = 10;
    scan.ranges.assign(kBeams, static_cast<float>(1 + 0.01 * published_++));
    began_.push_back(now.count() - static_cast<std::int64_t>(1e6 * kTurn_s));
    writer_->write(ros2::encode(scan));
  }
  /// When the scan with this range began, on this computer's steady clock.
  std::int64_t began_us(float range_m) const {
    return began_.at(static_cast<std::size_t>(std::lround((range_m - 1) / 0.01F)));
  }

 private:
  std::unique_ptr<dds::Participant> participant_;
  std::unique_ptr<dds::Writer> writer_;
  microseconds next_{};
  int published_ = 0;
  std::vector<std::int64_t> began_;
};

TrackerUrl url() { return tracker_url_in("ros2:/scan"); }
dds::Discovery discovery() { return {support::test_domain()}; }

TEST(RosScanLink, GivesScansWithTheTimeOfTheirFirstBeamOnThisComputersClock) {
  ScannerNode node;
  RosScanLink link(url(), discovery());
  std::vector<lidar::Scan> scans;
  const microseconds begin = steady_now();
  while (scans.size() < 12 && steady_now() - begin < kLongestWait) {
    node.work();
    for (lidar::Scan& scan : link.poll(milliseconds(5))) scans.push_back(std::move(scan));
  }
  ASSERT_GE(scans.size(), 12u);
  for (const lidar::Scan& scan : scans) {
    EXPECT_EQ(scan.ranges_m.size(), static_cast<std::size_t>(kBeams));
    EXPECT_NEAR(scan.beam_interval_s, kTurn_s / kBeams, 1e-6);
    EXPECT_GE(scan.time_ns / 1000, node.began_us(scan.ranges_m.front()) - 1) << "no scan is stamped early";
  }
  // The stamps of the sender are as even as its clock, however late the messages came.
  for (std::size_t i = 1; i < scans.size(); ++i)
    EXPECT_NEAR(1e-3 * static_cast<double>(scans[i].time_ns - scans[i - 1].time_ns),
                static_cast<double>(node.began_us(scans[i].ranges_m.front()) -
                                    node.began_us(scans[i - 1].ranges_m.front())),
                1.5);
}

TEST(RosScanLink, IsChosenByTheTypeOfTheTopic) {
  const ScannerNode node;
  EXPECT_TRUE(carries_scans(url(), discovery()));
  EXPECT_FALSE(carries_scans(tracker_url_in("ros2:/nobody"), discovery()));
}

}  // namespace
}  // namespace astro::truth
