#include "host/wall/wheel_watch.hpp"

#include <chrono>
#include <cmath>

#include "common/fixed/wrapping.hpp"

namespace astro::wall {
namespace {

using protocol::Telemetry;
using namespace std::chrono_literals;

constexpr std::uint16_t kPeriod_ms = 10;
constexpr std::uint32_t kFields = Telemetry::kCounts | Telemetry::kWheelSpeed | Telemetry::kSetpoint |
                                  Telemetry::kDuty | Telemetry::kBattery;
constexpr std::uint64_t kStood_us = 300'000;
constexpr double kFullDuty = 32767;

}  // namespace

WheelWatch::WheelWatch(robot::Client& client, double count_m, std::uint32_t more)
    : client_(client),
      count_m_(count_m),
      subscription_(client.on<Telemetry>([this](const Telemetry& telemetry) { take(telemetry); })) {
  client_.request(protocol::SetTelemetry{kPeriod_ms, kFields | more});
  fresh();
}

WheelWatch::~WheelWatch() {
  try {
    client_.request(protocol::SetTelemetry{0, 0});
  } catch (const std::exception&) {  // a robot that is gone sends no telemetry anyway
  }
}

void WheelWatch::take(const Telemetry& telemetry) {
  if ((telemetry.fields & kFields) != kFields) return;
  const std::array counts{telemetry.counts.left, telemetry.counts.right};
  if (!began_) counts_ = counts;
  began_ = true;
  const double left_m = count_m_ * wrapping_difference(counts[0], counts_[0]);
  const double right_m = count_m_ * wrapping_difference(counts[1], counts_[1]);
  travel_.left_m += left_m;
  travel_.right_m += right_m;
  travel_.left_path_m += std::abs(left_m);
  travel_.right_path_m += std::abs(right_m);
  if (counts != counts_) moved_us_ = telemetry.device_time_us;
  counts_ = counts;
  const double supply_V = 1e-3 * telemetry.battery.mv;
  now_ = {telemetry.device_time_us,
          {1e-6 * telemetry.wheel_speed.left_umps, 1e-6 * telemetry.wheel_speed.right_umps},
          {1e-6 * telemetry.setpoint.left_umps, 1e-6 * telemetry.setpoint.right_umps},
          {telemetry.duty.left / kFullDuty * supply_V, telemetry.duty.right / kFullDuty * supply_V}};
  seen(now_);
}

const WheelMoment& WheelWatch::fresh() {
  const std::uint64_t asked_us = client_.request(protocol::Ping{}).device_time_us;
  if (!client_.pump_until([&] { return now_.time_us > asked_us; }, 2s))
    throw robot::LinkLost(client_.name() + " sends no telemetry although it was asked to");
  return now_;
}

void WheelWatch::wait_until_wheels_stand() {
  fresh();
  const std::uint64_t from_us = now_.time_us;
  if (!client_.pump_until([&] { return now_.time_us >= std::max(from_us, moved_us_) + kStood_us; }, 3s))
    fresh();
}

}  // namespace astro::wall
