#include "host/commands/simulate/study_options.hpp"

#include "host/console/options.hpp"

namespace astro::commands {
void add_count(console::Command command, const std::string& name, int& value, int least, int greatest,
               const std::string& what) {
  command.add_option(name, value, what)
      .type_name("N")
      .check(console::whole(static_cast<std::uint64_t>(least), static_cast<std::uint64_t>(greatest)))
      .capture_default_str();
}

void add_size(console::Command command, const std::string& name, double& metres, const std::string& what) {
  add_ranged(command, name, metres, what, "M", 0.001, 1000, "m");
}

void add_ratio(console::Command command, const std::string& name, double& ratio, const std::string& what) {
  add_ranged(command, name, ratio, what, "RATIO", 0.5, 2, "");
}

void add_rate(console::Command command, const std::string& name, double& hz, const std::string& what) {
  add_ranged(command, name, hz, what, "HZ", 1, 1000, "Hz");
}

void add_noise(console::Command command, calibration::NoiseModel& noise, double& sigma_theta_deg,
               double& truth_rate_hz) {
  add_ranged(command, "--slip,--K", noise.K_m, "wheel slip: variance of the travel per metre, m", "M", 1e-12,
             0.01, "m");
  add_ranged(command, "--sigma-xy", noise.sigma_xy_m, "error of the ground truth's position, m", "M", 1e-9, 1,
             "m");
  add_ranged(command, "--sigma-theta", sigma_theta_deg, "error of the ground truth's heading, degrees", "DEG",
             1e-6, 90, "degrees");
  add_rate(command, "--truth-rate", truth_rate_hz, "of the ground truth, Hz");
}

}  // namespace astro::commands
