#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/live/driver/continuous_odometry.hpp"
#include "host/live/driver/diagnostics.hpp"
#include "host/live/driver/driving.hpp"
#include "host/live/driver/publications.hpp"
#include "host/live/driver/requests.hpp"
#include "host/live/driver/robot_link.hpp"
#include "host/live/driver/robot_parameter_table.hpp"
#include "host/recording/telemetry_sample.hpp"

namespace astro::live {

struct DriverOptions {
  std::string node = "robot";  // its name in /diagnostics
  std::string node_namespace;  // "" or "left"
  NameChoices names{};
  bool odom_tf = true;  // whether /tf has odom -> base_footprint, which another node may publish instead
  bool use_sim_time = false;  // whether stamps are the time of /clock
  /// Parameters of the robot, which are set once it was found. Names that the robot does not have are ignored.
  std::vector<ros2::msg::Parameter> robot_parameters{};
  double rate_hz = 50;  // of telemetry; up to 1000. The period is rounded to whole milliseconds.
  microseconds cmd_vel_timeout = std::chrono::milliseconds(500);
  bool velocities_after_stop = false;  // see Driving
  CommandType cmd_vel_type = CommandType::twist_stamped;
  std::optional<calibration::OdometryErrors> errors;  // none: those of an uncalibrated robot
  /// The wheel factors that `errors` belongs to. If the robot has others, /diagnostics says so.
  std::optional<calibration::WheelFactors> calibrated;
  FaultHelp fault_help = [](Fault) { return std::string_view(); };
  std::function<std::string(const Error&)> words = [](const Error& error) {
    return std::string(error.what());
  };
  /// Called with sentences about the link that a person should see.
  std::function<void(const std::string&)> notice = [](const std::string&) {};
  HostClock clock = HostClock::of_system();
};

/// Presents one robot as a ROS 2 node (host/live/README.md), on any number of middlewares at once. The driver goes on while
/// there is no robot, while the link is lost, and after the robot has restarted; it says so in /diagnostics and publishes no
/// odometry meanwhile.
///
/// Threads  one, which calls step(). A robot that falls silent blocks it for half a second, or for two seconds during a
///          parameter commit. A slow line blocks it for a few requests, never for a whole parameter table.
class Driver {
 public:
  /// The middlewares must outlive the driver, and be polled by nobody else.
  Driver(std::vector<Middleware*> middlewares, OpenPort open, DriverOptions options);
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  /// Answers what has come from others, and passes on what has come from the robot; waits up to `most` if there is nothing.
  void step(microseconds most = std::chrono::milliseconds(10));

  /// Calls step() while `goes_on` returns true, and then end(), also if something was thrown. Throws the first exception of
  /// `goes_on`, a middleware or end().
  void run(const std::function<bool()>& goes_on);

  /// These convert times of the robot's clock and of this computer's steady clock, in microseconds, to nanoseconds since
  /// 1970, as in the stamps of published messages. They return nothing while a simulation has to give the time and has not
  /// done so yet; the first also returns nothing while there is no robot or no round trip has measured its clock offset.
  std::optional<std::int64_t> utc_of_robot_ns(std::int64_t device_time_us);
  std::optional<std::int64_t> utc_of_host_ns(std::int64_t steady_us) {
    return utc_.known() ? std::optional(utc_.utc_ns(steady_us)) : std::nullopt;
  }

  /// Brings a robot that was armed here to rest and disarms it. Throws astro::Error if the robot does not confirm it.
  void end();

 private:
  void attend(RobotSession& session, microseconds most);
  void begin(RobotSession& session);
  void begin_odometry(RobotSession& session);
  bool read_on(RobotSession& session);
  void take(RobotSession& session, const protocol::Telemetry& telemetry);
  void publish(const protocol::Telemetry& telemetry, std::int64_t time_ns);
  void describe_robot(RobotSession& session);
  std::vector<OwnParameter> own_parameters();
  void use_sim_time(bool on);
  void lose(const Error& why);
  void note_link(const std::string& sentence);
  void report();
  DriverState state();
  Moment moment() const { return {utc_.steady(), utc_.now_ns(), utc_.steady() - polled_}; }

  std::vector<Middleware*> middlewares_;
  DriverOptions options_;
  Names names_;
  UtcMap utc_;
  microseconds polled_;  // when the middlewares were last polled: what they deliver now is newer
  RobotLink link_;
  Driving driving_;
  ContinuousOdometry odometry_;
  RobotParameterTable parameters_;
  Publications publications_;
  Requests requests_;
  ros2::RobotModel model_;
  std::optional<protocol::Telemetry> newest_;  // of this session
  recording::NewGyroPoses gyro_poses_;
  std::string noticed_;                                            // the last sentence
  bool hears_clock_ = false;                                       // subscribes to /clock
  bool set_up_ = false;                                            // the robot has what the options say
  bool restarted_ = false;                                         // the robot, in the session before
  std::int64_t published_ns_ = 0;                                  // since 1970
  std::int64_t battery_ns_ = 0, looked_ns_ = 0, reported_ns_ = 0;  // on the steady clock
  ros2::msg::DiagnosticArray reported_;
};

}  // namespace astro::live
