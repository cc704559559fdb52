#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/live/driver/robot_link.hpp"
#include "host/recording/run.hpp"
#include "host/simulation/robot/virtual_robot.hpp"

namespace astro::page {

/// A port at which a robot may be, and what answers there, for people.
struct RobotPort {
  std::string path, what;
};

/// The ports of whoever serves the page. A page in a browser has none.
struct RobotPorts {
  std::function<std::vector<RobotPort>()> list = [] { return std::vector<RobotPort>{}; };
  /// Throws astro::Error with the reason if the port cannot be opened; empty where there are no ports.
  std::function<std::unique_ptr<robot::Transport>(const std::string& path)> open;
  live::HostClock clock = live::HostClock::of_system();  // of what `open` returns
};

/// The robot that is open, at a port or simulated in this process. If its link is lost, it is looked for again.
class OpenedRobot {
 public:
  /// Both throw astro::Error with the reason if no robot answers.
  static std::unique_ptr<OpenedRobot> at_port(const RobotPorts& ports, const std::string& path);
  static std::unique_ptr<OpenedRobot> simulated(const sim::Config& config);

  const std::string& port() const { return port_; }
  bool is_simulated() const { return simulated_ != nullptr; }
  /// Null for a robot at a port.
  const std::shared_ptr<simulation::VirtualRobot>& simulation() const { return simulated_; }
  microseconds now() const { return clock_.steady(); }

  /// Null while the link is lost.
  live::RobotSession* session() { return link_.session(); }
  /// The same; throws astro::Error that says why there is none.
  live::RobotSession& required_session();
  live::RobotLink& link() { return link_; }

  /// Looks for a robot that was lost; true if it was found now. A robot that drives although nobody drives it was stopped.
  bool seek();
  /// Ends the session for this reason.
  void lose(const Error& why);

  /// Where a simulated robot really is, in the frame of its odometry at the start.
  std::optional<Pose2> truth() const;
  /// What the cameras of a simulated robot saw since the last call.
  std::vector<recording::TruthSample> take_truth();

 private:
  OpenedRobot(std::string port, live::OpenPort open, live::HostClock clock,
              std::shared_ptr<simulation::VirtualRobot> simulated);

  std::string port_;
  live::HostClock clock_;
  std::shared_ptr<simulation::VirtualRobot> simulated_;  // null at a port
  Pose2 start_;                                          // of a simulated robot
  live::RobotLink link_;
};

}  // namespace astro::page
