#include "host/commands/live/robot_driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/base/error.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "host/live/driver/robot_parameter_table.hpp"
#include "host/robot/client/robot_problem.hpp"

namespace astro::commands {
namespace {

constexpr double kLeastRate_hz = 1, kMostRate_hz = 1000, kLeastTimeout_s = 0.02, kMostTimeout_s = 10;

double number_of(const experiment::ParameterFile& file, const char* name, double otherwise) {
  const auto found = file.parameters.find(name);
  const double* number = found == file.parameters.end() ? nullptr : std::get_if<double>(&found->second);
  return number == nullptr ? otherwise : *number;
}

void take_calibration(const std::filesystem::path& path, live::DriverOptions& options) {
  const experiment::ParameterFile file = experiment::read_parameter_file(path);
  const auto covariance = experiment::covariance_in(file);
  if (!covariance)
    throw Error(
        "'" + path.string() +
        "' does not say how well its factors are known: it needs [covariance], or [standard_errors] of c_R, "
        "c_L and b, as 'astrolabe calibrate' writes them");
  if (!file.covariance)
    console::say(
        fmt::format("no length was measured for {}, so the covariance of /odom takes S as known to {:.1g} %",
                    path.string(), 100 * experiment::kErrorOfNominalScale));
  options.errors =
      calibration::OdometryErrors{file.slip_K_m.value_or(calibration::NoiseModel().K_m), *covariance};
  options.calibrated = calibration::WheelFactors{number_of(file, "c_R", 1), number_of(file, "c_L", 1),
                                                 number_of(file, "b", 0), number_of(file, "e", 0)};
}

/// A node that called a service can call another one, so the advice names a service.
std::string words_for_nodes(const Error& error) {
  if (error.kind() == Kind(robot::RobotProblem::faulted))
    return std::string(error.what()) + "; remove its cause, then call clear_faults";
  return in_words(error);
}

live::DriverOptions driver_options(const RobotDriverOptions& options, const std::string& node) {
  live::DriverOptions driver;
  driver.node = node;
  driver.node_namespace = options.node_namespace;
  driver.names = options.names;
  driver.odom_tf = options.odom_tf;
  driver.use_sim_time = options.use_sim_time;
  driver.robot_parameters = options.robot_parameters;
  driver.rate_hz = options.rate_hz;
  driver.cmd_vel_timeout = microseconds(std::llround(1e6 * options.cmd_vel_timeout_s));
  driver.velocities_after_stop = options.cmd_vel_after_stop;
  driver.cmd_vel_type = options.cmd_vel_type;
  driver.fault_help = fault_help;
  driver.words = words_for_nodes;
  driver.notice = [](const std::string& sentence) { console::say(sentence); };
  if (!options.calibration.empty()) take_calibration(options.calibration, driver);
  return driver;
}

[[noreturn]] void refuse(const ros2::msg::Parameter& parameter, const std::string& what) {
  throw console::WrongUsage(fmt::format("--ros-args: the parameter {} has to be {}", parameter.name, what));
}

bool is(const ros2::msg::Parameter& parameter, live::ParameterType type) {
  return parameter.value.type == static_cast<std::uint8_t>(type);
}

double number_from(const ros2::msg::Parameter& parameter, double least, double most) {
  const double value = is(parameter, live::ParameterType::integer)
                           ? static_cast<double>(parameter.value.integer_value)
                           : parameter.value.double_value;
  const bool is_number =
      is(parameter, live::ParameterType::integer) || is(parameter, live::ParameterType::real);
  if (!is_number || !(value >= least && value <= most))
    refuse(parameter, fmt::format("a number from {} to {}", least, most));
  return value;
}

bool truth_from(const ros2::msg::Parameter& parameter) {
  if (!is(parameter, live::ParameterType::boolean)) refuse(parameter, "true or false");
  return parameter.value.bool_value;
}

std::string frame_from(const ros2::msg::Parameter& parameter) {
  const std::string& frame = parameter.value.string_value;
  if (!is(parameter, live::ParameterType::text) || frame.empty() || frame.starts_with('/'))
    refuse(parameter, "the name of a frame, which does not begin with a /");
  return frame;
}

live::CommandType command_type_from(const ros2::msg::Parameter& parameter) {
  const auto& names = live::kCommandTypeNames;
  const auto found = std::ranges::find(names, parameter.value.string_value);
  if (found == names.end()) refuse(parameter, fmt::format("one of {}", fmt::join(names, ", ")));
  return static_cast<live::CommandType>(found - names.begin());
}

constexpr Advice kRobotDriverAdvice[] = {
    {live::TableProblem::needs_confirmation, "; 'astrolabe params set {0}' asks before it sets them"},
};

}  // namespace

live::Names names_of(const RobotDriverOptions& options) {
  return live::Names(options.node_namespace, options.names);
}

void take_parameters(const std::vector<ros2::msg::Parameter>& parameters, RobotDriverOptions& options) {
  for (const ros2::msg::Parameter& each : parameters) {
    if (each.name == "publish_rate")
      options.rate_hz = number_from(each, kLeastRate_hz, kMostRate_hz);
    else if (each.name == "cmd_vel_timeout")
      options.cmd_vel_timeout_s = number_from(each, kLeastTimeout_s, kMostTimeout_s);
    else if (each.name == "cmd_vel_after_stop")
      options.cmd_vel_after_stop = truth_from(each);
    else if (each.name == "cmd_vel_type")
      options.cmd_vel_type = command_type_from(each);
    else if (each.name == "odom_frame_id")
      options.names.odom_frame = frame_from(each);
    else if (each.name == "base_frame_id")
      options.names.base_frame = frame_from(each);
    else if (each.name == "enable_odom_tf")
      options.odom_tf = truth_from(each);
    else if (each.name == "use_sim_time")
      options.use_sim_time = truth_from(each);
    else
      options.robot_parameters.push_back(each);
  }
}

std::string absolute_namespace(const std::string& space) {
  return space.starts_with('/') ? space : '/' + space;
}

std::string what_is_wrong(const ros2::NodeName& node) {
  try {
    ros2::valid(node);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

void add_robot_driver_options(console::Command command, RobotDriverOptions& options) {
  advise(kRobotDriverAdvice);
  add_connection(command, options.connection);
  command.add_option("--namespace", options.node_namespace, "namespace of the node; its frames begin with it")
      .type_name("NAME")
      .check([](const std::string& space) {
        return what_is_wrong({"robot", absolute_namespace(space)});
      });
  console::add_ranged(command, "--rate", options.rate_hz,
                      "messages of odometry a second; the period is whole\nmilliseconds", "HZ", kLeastRate_hz,
                      kMostRate_hz, "Hz");
  console::add_ranged(command, "--cmd-vel-timeout", options.cmd_vel_timeout_s, "how long a velocity holds",
                      "S", kLeastTimeout_s, kMostTimeout_s, "s");
  command.add_flag(
      "--cmd-vel-after-stop", options.cmd_vel_after_stop,
      "the next velocity after a stop through this program\ndrives the robot again, without arming it");
  command
      .add_option("--calibration", options.calibration,
                  "calib.toml of the robot: how well its factors are\nknown and how its wheels slip "
                  "(default: as those\nof a robot that nobody has calibrated)")
      .type_name("FILE");
}

void drive_robot(const std::vector<live::Middleware*>& middlewares, const RobotDriverOptions& options,
                 const std::string& node, const std::function<void(live::Driver&)>& beside) {
  const auto open = [connection = options.connection] { return open_port(connection); };
  live::Driver driver(middlewares, open, driver_options(options, node));
  driver.run([&] {
    beside(driver);
    return !console::interrupted();
  });
}

}  // namespace astro::commands
