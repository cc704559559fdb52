#include "host/motor/bench/bench.hpp"

#include "common/fixed/wrapping.hpp"

namespace astro::motor {

using namespace protocol;  // NOLINT(google-build-using-namespace): this file is all messages
using std::chrono::milliseconds;

namespace {

constexpr std::uint64_t kStep_us = 20'000;
constexpr microseconds kStepAtMost = milliseconds(60);
constexpr std::uint32_t kFields = Telemetry::kCounts | Telemetry::kWheelSpeed | Telemetry::kSetpoint |
                                  Telemetry::kDuty | Telemetry::kBattery;
constexpr double kFullDuty = 32767;

}  // namespace

Bench::Bench(robot::Client& client, const RobotFacts& facts)
    : client_(client),
      facts_(facts),
      subscription_(client.on<Telemetry>([this](const Telemetry& telemetry) { note(telemetry); })) {
  choose_period();
  fresh();
}

Bench::~Bench() {
  try {
    client_.request(SetTelemetry{0, 0});
  } catch (const std::exception&) {  // a robot that is gone sends no telemetry anyway
  }
}

void Bench::choose_period() {
  constexpr int kTrial = 100;  // samples; one in twenty may be missing
  for (const std::uint16_t period_ms : std::to_array<std::uint16_t>({1, 2, 5, 10})) {
    client_.request(SetTelemetry{period_ms, kFields});
    const std::uint64_t begin_us = fresh().time_s >= 0 ? newest_us_ : 0;
    const std::size_t before = moments_.size();
    const std::uint64_t end_us = begin_us + std::uint64_t{period_ms} * 1000 * kTrial;
    client_.pump_until([&] { return newest_us_ >= end_us; }, milliseconds(2000));
    period_s_ = 1e-3 * period_ms;
    if (moments_.size() - before >= kTrial * 95 / 100) break;
  }
}

void Bench::note(const Telemetry& telemetry) {
  if ((telemetry.fields & kFields) != kFields) return;
  const std::array counts{telemetry.counts.left, telemetry.counts.right};
  if (moments_.empty()) {
    first_us_ = telemetry.device_time_us;
    seen_ = counts;
  }
  Moment moment = moments_.empty() ? Moment{} : moments_.back();
  newest_us_ = telemetry.device_time_us;
  moment.time_s = static_cast<double>(newest_us_ - first_us_) * 1e-6;
  moment.supply_V = 1e-3 * telemetry.battery.mv;
  moment.voltage_V = {telemetry.duty.left / kFullDuty * moment.supply_V,
                      telemetry.duty.right / kFullDuty * moment.supply_V};
  moment.observed_mps = {1e-6 * telemetry.wheel_speed.left_umps, 1e-6 * telemetry.wheel_speed.right_umps};
  moment.set_point_mps = {1e-6 * telemetry.setpoint.left_umps, 1e-6 * telemetry.setpoint.right_umps};
  for (std::size_t side = 0; side < 2; ++side) {
    moment.counts[side] += wrapping_difference(counts[side], seen_[side]);
    moment.position_m[side] = static_cast<double>(moment.counts[side]) * facts_.count_m[side];
  }
  seen_ = counts;
  moments_.push_back(moment);
}

const Moment& Bench::fresh() {
  const std::uint64_t now_us = client_.request(Ping{}).device_time_us;
  if (!client_.pump_until([&] { return newest_us_ > now_us; }, std::chrono::seconds(2)))
    throw robot::LinkLost(client_.name() + " sends no telemetry although it was asked to");
  return moments_.back();
}

// Returns at the first sample that is late enough. Later samples are read by the next request.
void Bench::wait_step() {
  const std::uint64_t next_us = newest_us_ + kStep_us;
  client_.pump_until([&] { return newest_us_ >= next_us; }, kStepAtMost);
}

void Bench::apply(robot::DriveSession& session, double left_V, double right_V) {
  session.set_wheel_voltages(left_V, right_V);
  wait_step();
}

void Bench::velocity(robot::DriveSession& session, double v_mps) {
  session.set_velocity(v_mps, 0);
  wait_step();
}

void Bench::hold(robot::DriveSession& session, double left_V, double right_V, double seconds) {
  const double end_s = now().time_s + seconds;
  while (now().time_s < end_s) apply(session, left_V, right_V);
}

}  // namespace astro::motor
