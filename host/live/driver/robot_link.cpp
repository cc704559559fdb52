#include "host/live/driver/robot_link.hpp"

#include <algorithm>
#include <cmath>

#include "common/params/table.hpp"
#include "host/robot/client/handshake.hpp"
#include "host/robot/motion/other_program.hpp"

namespace astro::live {

using std::chrono::milliseconds;

namespace {

constexpr robot::RetryPolicy kHandshake{milliseconds(60), 6};
constexpr std::size_t kMostSamples =
    4096;  // what a blocked driver may find waiting: four seconds at the highest rate
constexpr microseconds kBetweenTries = milliseconds(200);

}  // namespace

RobotSession::RobotSession(std::unique_ptr<robot::Transport> transport,
                           const std::optional<protocol::HelloReply>& known, protocol::SetTelemetry telemetry)
    : client_(connected(std::move(transport), known)),
      wanted_(telemetry),
      parameters_(robot::RemoteParameters::begin(*client_, kPatience.tries)) {
  on_boot_ = client_->on<protocol::Booted>([this](const protocol::Booted&) { restarted_ = true; });
  on_fault_ = client_->on<protocol::FaultRaised>([this](const protocol::FaultRaised&) { fault_ = true; });
  on_telemetry_ = client_->on<protocol::Telemetry>([this](const protocol::Telemetry& sample) {
    telemetry_at_ = client_->now();
    if (samples_.size() == kMostSamples) samples_.pop_front();
    samples_.push_back(sample);
  });
  numbers_["command_timeout"] =
      ask(protocol::GetParameter{static_cast<std::uint16_t>(Param::command_timeout)}).active;
  ask_for_telemetry(wanted_);
  telemetry_at_ = client_->now();
}

std::unique_ptr<robot::Client> RobotSession::connected(std::unique_ptr<robot::Transport> transport,
                                                       const std::optional<protocol::HelloReply>& known) {
  auto client = std::make_unique<robot::Client>(std::move(transport));
  const protocol::HelloReply& answers = client->connect(kHandshake);
  if (known) robot::require_same_robot(client->name(), *known, answers);
  return client;
}

bool RobotSession::read_parameters(microseconds most) {
  const microseconds until = client_->now() + most;
  while (!parameters_.is_complete()) {
    parameters_.read_next();
    if (client_->now() >= until) break;
  }
  if (!parameters_.is_complete()) return false;
  note_parameters();
  return true;
}

void RobotSession::ask_for_telemetry(protocol::SetTelemetry telemetry) {
  wanted_ = telemetry;
  asked_at_ = client_->now();
  ask(wanted_);
}

bool RobotSession::stop_left_drive() {
  const double timeout_ms = numbers_.at("command_timeout");
  return robot::stop_left_drive(*client_, microseconds(std::llround(1e3 * timeout_ms)));
}

void RobotSession::keep_telemetry() {
  const microseconds patience =
      std::max<microseconds>(milliseconds(500), milliseconds(5 * wanted_.period_ms));
  if (telemetry_age() > patience && client_->now() - asked_at_ > patience) ask_for_telemetry(wanted_);
}

void RobotSession::pump(microseconds most) {
  client_->pump_until([&] { return !samples_.empty() || restarted_ || fault_; }, most);
}

std::optional<protocol::Telemetry> RobotSession::take_sample() {
  if (samples_.empty()) return std::nullopt;
  const protocol::Telemetry sample = samples_.front();
  samples_.pop_front();
  return sample;
}

bool RobotLink::seek() {
  if (session_ || (tried_ && clock_.steady() - *tried_ < kBetweenTries)) return false;
  try {
    session_ = std::make_unique<RobotSession>(open_(), robot_, telemetry_);
    robot_ = session_->client().robot();
    tried_.reset();
  } catch (const Error& error) {
    why_ = error;
    tried_ = clock_.steady();
  }
  return session_ != nullptr;
}

void RobotLink::ask_for_telemetry(protocol::SetTelemetry telemetry) {
  telemetry_ = telemetry;
  if (session_) session_->ask_for_telemetry(telemetry);
}

void RobotLink::lose(const Error& why) {
  why_ = why;
  session_.reset();
  ++losses_;
}

}  // namespace astro::live
