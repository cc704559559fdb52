#include "host/commands/robot/monitor_view.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/console/console.hpp"
#include "host/console/terminal.hpp"
#include "host/recording/telemetry_sample.hpp"

namespace astro::commands {
namespace {

using protocol::Telemetry;

double duty(std::int16_t raw) { return std::ldexp(raw, -15); }
double mps(std::int32_t umps) { return umps / 1e6; }

std::string mode_in_words(const protocol::StateGroup& state) {
  const std::string mode(protocol::name(state.mode));
  return state.tag == 0 ? mode : fmt::format("{} {}", mode, state.tag);
}

std::string wheels(const Telemetry& telemetry) {
  constexpr int kHalf = 10;
  const auto row = [](const char* name, std::int32_t set, std::int32_t is, std::int16_t drive,
                      std::int32_t counts) {
    return fmt::format("  {:<6} {:+8.3f}  {:+8.3f}    {}  {:+6.1f} %  {:12}\n", name,
                       without_minus_zero(mps(set), 3), without_minus_zero(mps(is), 3),
                       console::gauge(duty(drive), kHalf), without_minus_zero(100 * duty(drive), 1), counts);
  };
  return "  wheel   set m/s    is m/s    duty                               counts\n" +
         row("left", telemetry.setpoint.left_umps, telemetry.wheel_speed.left_umps, telemetry.duty.left,
             telemetry.counts.left) +
         row("right", telemetry.setpoint.right_umps, telemetry.wheel_speed.right_umps, telemetry.duty.right,
             telemetry.counts.right);
}

std::string link_line(const LinkFigures& link) {
  if (!link.lost.empty()) return "  link      LOST: " + link.lost + "\n";
  const std::string drift =
      link.drift ? fmt::format("{:+.1f} ppm", without_minus_zero(*link.drift * 1e6, 1)) : "not known yet";
  return fmt::format("  link      round trip {:.2f} ms   robot's clock {}\n", link.round_trip_ms, drift) +
         fmt::format("            frames {} good, {} bad   repeated {}   lost pings {}\n", link.frames.good,
                     link.frames.bad(), link.counts.repeats, link.counts.lost_pings);
}

/// Nothing for a robot that uses no gyro.
std::string gyro_line(const Telemetry& telemetry) {
  const auto at = recording::gyro_pose(telemetry);
  if (!at) return {};
  return fmt::format("  gyro      {:<9} rate {:+8.2f} deg/s   heading {:10.2f} deg   slips {}\n",
                     protocol::name(telemetry.fused.gyro), without_minus_zero(degrees(at->omega_radps), 2),
                     without_minus_zero(degrees(at->theta_rad), 2), telemetry.fused.slips);
}

Json gyro_json(const recording::GyroPose& at, const Telemetry& telemetry) {
  const protocol::FusedGroup& fused = telemetry.fused;
  Json json{{"state", std::string(protocol::name(fused.gyro))},
            {"x_m", at.x_m},
            {"y_m", at.y_m},
            {"theta_rad", at.theta_rad},
            {"rate_radps", at.omega_radps},
            {"bias_radps", fused.bias_uradps * 1e-6},
            {"slips", fused.slips}};
  if (fused.temperature_cC != INT16_MIN) json["temperature_C"] = fused.temperature_cC / 100.0;
  return json;
}

Json wheel(std::int32_t set_umps, std::int32_t is_umps, std::int16_t drive, std::int32_t counts) {
  return {{"setpoint_mps", mps(set_umps)},
          {"speed_mps", mps(is_umps)},
          {"duty", duty(drive)},
          {"counts", counts}};
}

}  // namespace

std::string monitor_picture(const std::string& robot, const Telemetry& telemetry, const LinkFigures& link) {
  const recording::OdometrySample at = recording::to_sample(telemetry);
  return fmt::format("\n  {}   running for {}\n\n", robot, duration_in_words(telemetry.device_time_us)) +
         fmt::format("  mode      {}\n", mode_in_words(telemetry.state)) +
         fmt::format("  faults    {}\n", faults_in_words(telemetry.state.latched_faults)) +
         fmt::format("  battery   {:.2f} V\n\n", telemetry.battery.mv / 1e3) +
         fmt::format("  pose      x {:10.4f} m     y {:10.4f} m     heading {:10.2f} deg\n",
                     without_minus_zero(at.x_m, 4), without_minus_zero(at.y_m, 4),
                     without_minus_zero(degrees(at.theta_rad), 2)) +
         fmt::format("  velocity  v {:+10.3f} m/s   omega {:+8.3f} rad/s\n", without_minus_zero(at.v_mps, 3),
                     without_minus_zero(at.omega_radps, 3)) +
         gyro_line(telemetry) + "\n" + wheels(telemetry) + "\n" + link_line(link) + "\n  Q quits\n";
}

std::string monitor_line(const Telemetry& telemetry, const LinkFigures& link) {
  if (!link.lost.empty()) return "link LOST: " + link.lost;
  const recording::OdometrySample at = recording::to_sample(telemetry);
  const std::uint32_t faults = telemetry.state.latched_faults;
  return fmt::format("{}{}  {:.2f} V  {}", mode_in_words(telemetry.state),
                     faults == 0 ? "" : ", " + faults_in_words(faults), telemetry.battery.mv / 1e3,
                     in_short_words({at.x_m, at.y_m, at.theta_rad}));
}

Json to_json(const Telemetry& telemetry) {
  const recording::OdometrySample at = recording::to_sample(telemetry);
  Json json{{"time_s", static_cast<double>(telemetry.device_time_us) / 1e6},
            {"mode", std::string(protocol::name(telemetry.state.mode))},
            {"segment", telemetry.state.tag},
            {"faults", fault_list(telemetry.state.latched_faults)},
            {"battery_V", telemetry.battery.mv / 1e3},
            {"x_m", at.x_m},
            {"y_m", at.y_m},
            {"theta_rad", at.theta_rad},
            {"v_mps", at.v_mps},
            {"omega_radps", at.omega_radps},
            {"left", wheel(telemetry.setpoint.left_umps, telemetry.wheel_speed.left_umps, telemetry.duty.left,
                           telemetry.counts.left)},
            {"right", wheel(telemetry.setpoint.right_umps, telemetry.wheel_speed.right_umps,
                            telemetry.duty.right, telemetry.counts.right)}};
  if (const auto pose = recording::gyro_pose(telemetry)) json["gyro"] = gyro_json(*pose, telemetry);
  return json;
}

}  // namespace astro::commands
