#include "host/commands/shared/drive_recording.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/robot/parameters/parameters.hpp"

namespace astro::commands {

recording::RunInfo describe_robot(robot::Client& client) {
  return experiment::info_of(client.robot(), robot::RemoteParameters::fetch(client).numbers());
}

void DriveRecording::check(const std::filesystem::path& file) {
  if (!file.empty() && std::filesystem::exists(file))
    throw Error(
        fmt::format("'{}' exists, and a recording replaces nothing: name another file", file.string()));
}

DriveRecording::DriveRecording(const std::filesystem::path& file, robot::Client& client)
    : info_(describe_robot(client)),
      writer_(file, info_),
      slips_(client.on<protocol::SlipFound>(
          [this](const protocol::SlipFound& found) { write_since_start(recording::to_sample(found)); })),
      gyro_(client.on<protocol::Telemetry>([this](const protocol::Telemetry& telemetry) {
        if (const auto pose = gyro_poses_.next(telemetry)) write_since_start(*pose);
      })) {}

DriveRecording::~DriveRecording() {
  try {
    close();
  } catch (const Error& error) {
    console::say(in_words(error));
  } catch (const std::exception& error) {
    console::say(error.what());
  }
}

void DriveRecording::add(const recording::OdometrySample& sample) {
  if (!first_us_) first_us_ = sample.time_us;
  write(sample);
}

template <class Sample>
void DriveRecording::write_since_start(const Sample& sample) {
  if (first_us_ && sample.time_us >= *first_us_) write(sample);
}

template <class Sample>
void DriveRecording::write(const Sample& sample) {
  if (!open_) return;
  try {
    writer_.add(sample);
  } catch (...) {
    failure_ = std::current_exception();
    open_ = false;
  }
}

void DriveRecording::close() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  if (!open_) return;
  open_ = false;
  writer_.close(info_);
}

}  // namespace astro::commands
