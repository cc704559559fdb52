#include "host/commands/drive/odometry_watch.hpp"

#include <utility>

#include "host/recording/run/telemetry_sample.hpp"

namespace astro::commands {

using protocol::SetTelemetry;
using protocol::Telemetry;

OdometryWatch::OdometryWatch(robot::Client& client, std::uint16_t period_ms, Listener listener,
                             std::uint32_t fields)
    : client_(client),
      subscription_(client.on<Telemetry>([this, hear = std::move(listener)](const Telemetry& telemetry) {
        if ((telemetry.fields & Telemetry::kPose) == 0) return;
        newest_ = recording::to_sample(telemetry);
        hear(newest_);
      })) {
  client_.request(SetTelemetry{period_ms, fields});
}

OdometryWatch::~OdometryWatch() {
  try {
    client_.request(SetTelemetry{0, 0});
  } catch (const std::exception&) {  // a lost robot sends no telemetry anyway
  }
}

const recording::OdometrySample& OdometryWatch::fresh() {
  const auto now_us = static_cast<std::int64_t>(client_.request(protocol::Ping{}).device_time_us);
  if (!client_.pump_until([&] { return newest_.time_us > now_us; }, std::chrono::seconds(2)))
    throw robot::LinkLost(client_.name() + " sends no odometry although it was asked to");
  return newest_;
}

}  // namespace astro::commands
