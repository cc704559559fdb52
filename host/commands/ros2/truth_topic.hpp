#pragma once

#include <chrono>
#include <memory>

#include "host/ros2/driver/driver.hpp"
#include "host/ros2/middleware/middleware.hpp"
#include "host/truth/source/source.hpp"

namespace astro::commands {

/// Ground truth as the topic /truth (geometry_msgs/PoseStamped, in the tracker's frame). Of a tracker that is lost and found again
/// it says both once; a pose that the tracker does not see is one of NaNs.
class TruthTopic {
 public:
  /// `middleware` must outlive it.
  TruthTopic(ros2::Middleware& middleware, std::unique_ptr<truth::Source> source);

  /// Publishes what has come; never waits. The driver knows what the robot's clock shows.
  void step(ros2::Driver& driver);

 private:
  void publish(ros2::Driver& driver);

  std::unique_ptr<truth::Source> source_;
  std::unique_ptr<ros2::Publisher> publisher_;
  bool lost_ = false;
  std::chrono::steady_clock::time_point ask_at_{};
};

}  // namespace astro::commands
