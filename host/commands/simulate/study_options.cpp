#include "host/commands/simulate/study_options.hpp"

#include <utility>

#include "host/console/options.hpp"

namespace astro::commands {
namespace {

void add_number(console::Command command, const std::string& name, double& value, const std::string& type,
                console::Check accepted, const std::string& what) {
  command.add_option(name, value, what).type_name(type).check(std::move(accepted)).capture_default_str();
}

}  // namespace

void add_count(console::Command command, const std::string& name, int& value, int least, int greatest,
               const std::string& what) {
  command.add_option(name, value, what)
      .type_name("N")
      .check(console::whole(static_cast<std::uint64_t>(least), static_cast<std::uint64_t>(greatest)))
      .capture_default_str();
}

void add_size(console::Command command, const std::string& name, double& metres, const std::string& what) {
  add_number(command, name, metres, "M", console::between(0.001, 1000, "m"), what);
}

void add_ratio(console::Command command, const std::string& name, double& ratio, const std::string& what) {
  add_number(command, name, ratio, "RATIO", console::between(0.5, 2, ""), what);
}

void add_rate(console::Command command, const std::string& name, double& hz, const std::string& what) {
  add_number(command, name, hz, "HZ", console::between(1, 1000, "Hz"), what);
}

void add_noise(console::Command command, calibration::NoiseModel& noise, double& sigma_theta_deg,
               double& truth_rate_hz) {
  add_number(command, "--slip,--K", noise.K_m, "M", console::between(1e-12, 0.01, "m"),
             "wheel slip: variance of the travel per metre, m");
  add_number(command, "--sigma-xy", noise.sigma_xy_m, "M", console::between(1e-9, 1, "m"),
             "error of the ground truth's position, m");
  add_number(command, "--sigma-theta", sigma_theta_deg, "DEG", console::between(1e-6, 90, "degrees"),
             "error of the ground truth's heading, degrees");
  add_rate(command, "--truth-rate", truth_rate_hz, "of the ground truth, Hz");
}

}  // namespace astro::commands
