#include "host/commands/ros2/robot_driver.hpp"

#include <cmath>

#include "host/base/error.hpp"
#include "host/calibration/motion/trajectory.hpp"
#include "host/commands/base/remedies.hpp"
#include "host/commands/shared/fault_help.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/experiment/analysis/calibration_file.hpp"

namespace astro::commands {
namespace {

double number_of(const experiment::ParameterFile& file, const char* name, double otherwise) {
  const auto found = file.parameters.find(name);
  const double* number = found == file.parameters.end() ? nullptr : std::get_if<double>(&found->second);
  return number == nullptr ? otherwise : *number;
}

void take_calibration(const std::filesystem::path& path, ros2::DriverOptions& options) {
  const experiment::ParameterFile file = experiment::read_parameter_file(path);
  if (!file.covariance)
    throw Error("'" + path.string() +
                "' does not say how well its factors are known: calibrate with --method ml, which does");
  options.errors =
      calibration::OdometryErrors{file.slip_K_m.value_or(calibration::NoiseModel().K_m), *file.covariance};
  options.calibrated = calibration::WheelFactors{number_of(file, "c_R", 1), number_of(file, "c_L", 1),
                                                 number_of(file, "b", 0), number_of(file, "e", 0)};
}

/// Who called a service can call another one.
std::string words_for_nodes(const Error& error) {
  if (error.remedy().help == Help::clear_faults)
    return std::string(error.what()) + "; remove its cause, then call clear_faults";
  return in_words(error);
}

ros2::DriverOptions driver_options(const RobotDriverOptions& options, const std::string& node) {
  ros2::DriverOptions driver;
  driver.node = node;
  driver.node_namespace = options.node_namespace;
  driver.rate_hz = options.rate_hz;
  driver.cmd_vel_timeout = microseconds(std::llround(1e6 * options.cmd_vel_timeout_s));
  driver.velocities_after_stop = options.cmd_vel_after_stop;
  driver.fault_help = fault_help;
  driver.words = words_for_nodes;
  driver.notice = [](const std::string& sentence) { console::say(sentence); };
  if (!options.calibration.empty()) take_calibration(options.calibration, driver);
  return driver;
}

}  // namespace

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
  add_connection(command, options.connection);
  command.add_option("--namespace", options.node_namespace, "namespace of the node; its frames begin with it")
      .type_name("NAME")
      .check([](const std::string& space) {
        return what_is_wrong({"robot", absolute_namespace(space)});
      });
  console::add_ranged(command, "--rate", options.rate_hz,
                      "messages of odometry a second; the period is whole\nmilliseconds", "HZ", 1, 1000,
                      "Hz");
  console::add_ranged(command, "--cmd-vel-timeout", options.cmd_vel_timeout_s, "how long a velocity holds",
                      "S", 0.02, 10, "s");
  command.add_flag(
      "--cmd-vel-after-stop", options.cmd_vel_after_stop,
      "the next velocity after a stop through this program\ndrives the robot again, without arming it");
  command
      .add_option("--calibration", options.calibration,
                  "calib.toml of the robot: how well its factors are\nknown and how its wheels slip "
                  "(default: as those\nof a robot that nobody has calibrated)")
      .type_name("FILE");
}

void drive_robot(const std::vector<ros2::Middleware*>& middlewares, const RobotDriverOptions& options,
                 const std::string& node, const std::function<void(ros2::Driver&)>& beside) {
  const auto open = [connection = options.connection] { return open_port(connection); };
  ros2::Driver driver(middlewares, open, driver_options(options, node));
  driver.run([&] {
    beside(driver);
    return !console::interrupted();
  });
  console::check_interrupt();
}

}  // namespace astro::commands
