#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "host/truth/live/socket_source.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"

namespace astro::support {

// Five times the usual 200 ms, so that no machine is so busy that a robot stops before the test wants it to.
inline constexpr std::chrono::milliseconds kTimeout(1000);
// After that time-out the robot ramps from 0.4 m/s to rest at 0.5 m/s^2: 1.8 s. A camera period and what the simulator was
// behind when the program was killed come on top.
inline constexpr double kToRest_s = 2.0;

/// A simulator in real time, and its cameras, which say what the robot really does. All bounds are on the
/// robot's clock, so a busy machine does not move them.
class WatchedDrive : public testing::Test {
 protected:
  explicit WatchedDrive(const std::vector<std::string>& options = {}) : simulator_(options) {
    forgive_late_hosts(simulator_.port(), kTimeout);
  }

  Program drive(const std::vector<std::string>& what) const {
    std::vector<std::string> words{ASTROLABE_PROGRAM, "drive"};
    words.insert(words.end(), what.begin(), what.end());
    words.insert(words.end(), {"--port", simulator_.port()});
    return Program(words);
  }

  /// Waits until the robot has gone this far from where it is now.
  bool has_gone(double metres) {
    track_.clear();
    return eventually([&] {
      look();
      return !track_.empty() && distance(track_.front(), track_.back()) > metres;
    });
  }

  /// Waits until the robot has stood still for 0.3 s; returns for how long it moved after `from_us`.
  double seconds_to_rest(std::int64_t from_us) {
    std::int64_t rest_us = -1;
    EXPECT_TRUE(eventually([&] { return (look(), rest_us = standing_since()) >= 0; }));
    const double seconds = static_cast<double>(rest_us - from_us) / 1e6;
    RecordProperty("seconds_to_rest", std::to_string(seconds));
    return seconds;
  }

  std::int64_t now_us() {
    look();
    return track_.back().time_us;
  }

  nlohmann::json info() const {
    return support::parse_json(astrolabe({"info", "--json", "--port", simulator_.port()}).out);
  }

  support::Simulator simulator_;

 private:
  void look() {
    for (const auto& sample : cameras_.poll()) track_.push_back(sample);
  }
  static double distance(const recording::TruthSample& a, const recording::TruthSample& b) {
    return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
  }
  // Cameras have 0.2 mm of noise: 2 mm within 0.3 s is 7 mm/s and ten times the noise.
  std::int64_t standing_since() const {
    constexpr std::int64_t kLongEnough_us = 300'000;
    constexpr double kStill_m = 0.002;
    if (track_.empty()) return -1;
    auto first = track_.rbegin();
    while (first != track_.rend() && distance(*first, track_.back()) < kStill_m) ++first;
    const std::int64_t since_us = first == track_.rend() ? track_.front().time_us : first->time_us;
    return track_.back().time_us - since_us >= kLongEnough_us ? since_us : -1;
  }

  truth::SocketSource cameras_{truth::mocap_socket_of(simulator_.port())};
  std::vector<recording::TruthSample> track_;
};

}  // namespace astro::support
