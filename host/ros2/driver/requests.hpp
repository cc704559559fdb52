#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/ros2/driver/continuous_odometry.hpp"
#include "host/ros2/driver/driving.hpp"
#include "host/ros2/driver/names.hpp"
#include "host/ros2/driver/robot_link.hpp"
#include "host/ros2/messages/geometry.hpp"
#include "host/ros2/messages/std.hpp"
#include "host/ros2/middleware/middleware.hpp"

namespace astro::ros2 {

/// What others ask of the robot: velocities, poses, and the services, of which host/ros2/README.md has the list.
class Requests {
 public:
  /// Whom they concern. All of it must outlive the middlewares' callbacks.
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
  /// Asks the robot; returns what was done, or throws why not.
  using Work = std::function<std::string(RobotSession&)>;

  void subscribe_to_velocities(CommandType type);
  void serve_all();
  template <Message M, class Take>
  void subscribe(Middleware& middleware, std::string_view name, int depth, bool reliable, Take take);
  void serve(std::string_view name, Work work);
  msg::Trigger::Response attempt(const Work& work);
  void set_pose(const std::optional<msg::PoseWithCovarianceStamped>& message);

  std::span<Middleware* const> middlewares_;
  const Names& names_;
  Robot robot_;
};

}  // namespace astro::ros2
