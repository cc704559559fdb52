#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "host/ros2/driver/driver.hpp"
#include "host/ros2/driver/names.hpp"
#include "host/ros2/middleware/middleware.hpp"
#include "host/truth/source/source.hpp"

namespace astro::commands {

/// Ground truth as the topic truth of the node (geometry_msgs/PoseStamped, in the tracker's frame). Of a tracker that is lost and
/// found again it says both once; a pose that the tracker does not see is one of NaNs.
class TruthTopic {
 public:
  using Open = std::function<std::unique_ptr<truth::Source>()>;

  /// `open` opens the source again after it was lost, without waiting; null for a source that comes back by itself.
  /// `middleware` must outlive it.
  TruthTopic(ros2::Middleware& middleware, const ros2::Names& names, std::unique_ptr<truth::Source> source,
             Open open);

  /// Publishes what has come; never waits. The driver knows what the robot's clock shows.
  void step(ros2::Driver& driver);

 private:
  void publish(ros2::Driver& driver);

  Open open_;
  std::unique_ptr<truth::Source> source_;  // null while it is lost
  std::unique_ptr<ros2::Publisher> publisher_;
  bool lost_ = false;
  std::chrono::steady_clock::time_point ask_at_{};
};

}  // namespace astro::commands
