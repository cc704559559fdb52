#include "host/page/robot/signals.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "host/base/error.hpp"
#include "host/recording/telemetry_sample.hpp"

namespace astro::page {
namespace {

using protocol::Telemetry;
using recording::to_sample;

double micro(std::int32_t value) { return value / 1e6; }
double fraction(int value) { return std::ldexp(value, -15); }
/// To the nanometre, which is far below what odometry knows: JSON then has fewer digits.
double nano(double value) { return std::round(value * 1e9) / 1e9; }

constexpr std::array kSignals{
    Signal{"x", "m", "pose", Telemetry::kPose, [](const Telemetry& t) { return nano(to_sample(t).x_m); }},
    Signal{"y", "m", "pose", Telemetry::kPose, [](const Telemetry& t) { return nano(to_sample(t).y_m); }},
    Signal{"heading", "rad", "pose", Telemetry::kPose,
           [](const Telemetry& t) { return nano(to_sample(t).theta_rad); }},
    Signal{"v", "m/s", "velocity", Telemetry::kTwist,
           [](const Telemetry& t) { return micro(t.twist.v_umps); }},
    Signal{"omega", "rad/s", "velocity", Telemetry::kTwist,
           [](const Telemetry& t) { return micro(t.twist.omega_uradps); }},
    Signal{"left_speed", "m/s", "wheel speeds", Telemetry::kWheelSpeed,
           [](const Telemetry& t) { return micro(t.wheel_speed.left_umps); }},
    Signal{"right_speed", "m/s", "wheel speeds", Telemetry::kWheelSpeed,
           [](const Telemetry& t) { return micro(t.wheel_speed.right_umps); }},
    Signal{"left_setpoint", "m/s", "wheel speeds", Telemetry::kSetpoint,
           [](const Telemetry& t) { return micro(t.setpoint.left_umps); }},
    Signal{"right_setpoint", "m/s", "wheel speeds", Telemetry::kSetpoint,
           [](const Telemetry& t) { return micro(t.setpoint.right_umps); }},
    Signal{"left_duty", "1", "duty", Telemetry::kDuty,
           [](const Telemetry& t) { return fraction(t.duty.left); }},
    Signal{"right_duty", "1", "duty", Telemetry::kDuty,
           [](const Telemetry& t) { return fraction(t.duty.right); }},
    Signal{"left_counts", "counts", "encoders", Telemetry::kCounts,
           [](const Telemetry& t) -> double { return t.counts.left; }},
    Signal{"right_counts", "counts", "encoders", Telemetry::kCounts,
           [](const Telemetry& t) -> double { return t.counts.right; }},
    Signal{"battery", "V", "battery", Telemetry::kBattery,
           [](const Telemetry& t) { return t.battery.mv / 1e3; }},
    Signal{"segment", "1", "path", Telemetry::kPath, [](const Telemetry& t) -> double { return t.path.tag; }},
    Signal{"segment_progress", "1", "path", Telemetry::kPath,
           [](const Telemetry& t) { return fraction(t.path.progress); }},
    Signal{"cross_track_error", "m", "path", Telemetry::kPath,
           [](const Telemetry& t) { return micro(t.path.cross_track_um); }},
    Signal{"heading_error", "rad", "path", Telemetry::kPath,
           [](const Telemetry& t) { return micro(t.path.heading_error_urad); }},
    Signal{"gyro_rate", "rad/s", "gyro", Telemetry::kFused,
           [](const Telemetry& t) { return micro(t.fused.rate_uradps); }},
    Signal{"gyro_bias", "rad/s", "gyro", Telemetry::kFused,
           [](const Telemetry& t) { return micro(t.fused.bias_uradps); }},
};

}  // namespace

std::span<const Signal> signals() { return kSignals; }

const Signal& signal_named(std::string_view name) {
  for (const Signal& each : kSignals)
    if (each.name == name) return each;
  throw Error(fmt::format("there is no signal '{}'", name), {}, {std::string(name)});
}

}  // namespace astro::page
