#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/std.hpp"
#include "host/live/driver/continuous_odometry.hpp"
#include "host/live/driver/driving.hpp"
#include "host/live/driver/middleware.hpp"
#include "host/live/driver/names.hpp"
#include "host/live/driver/robot_link.hpp"

namespace astro::live {

/// Takes what others request of the robot: velocities, poses, and the services that host/live/README.md lists.
class Requests {
 public:
  /// What the requests act on. All of it must outlive the middlewares' callbacks.
  struct Robot {
    RobotLink& link;
    Driving& driving;
    ContinuousOdometry& odometry;
    std::function<Moment()> now;
    std::function<void(const Error&)> lose;          // the link was lost meanwhile
    std::function<std::string(const Error&)> words;  // for people
    std::function<void(const std::string&)> notice;  // a sentence that is worth showing
  };

  Requests(std::span<Middleware* const> middlewares, const Names& names, CommandType velocities, Robot robot);

 private:
  /// Carries out a request; returns what was done, or throws with the reason.
  using Work = std::function<std::string(RobotSession&)>;

  void subscribe_to_velocities(CommandType type);
  void serve_all();
  template <ros2::Message M, class Take>
  void subscribe(Middleware& middleware, std::string_view name, int depth, bool reliable, Take take);
  void serve(std::string_view name, Work work);
  ros2::msg::Trigger::Response attempt(const Work& work);
  void set_pose(const std::optional<ros2::msg::PoseWithCovarianceStamped>& message);

  std::span<Middleware* const> middlewares_;
  const Names& names_;
  Robot robot_;
};

}  // namespace astro::live
