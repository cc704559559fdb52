#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"
#include "common/safety/fault.hpp"

/// As much of a robot as the host's side of the link can tell: bytes in, bytes out, a clock of its own. Knows
/// no motion: a segment takes kSegment_us. It remembers its last reply as host/robot/client asks of a robot.
namespace astro::test {

struct FakeParameter {
  protocol::ParameterInfo info;
  protocol::ParameterValue value;
};

class FakeRobot {
 public:
  static constexpr std::uint64_t kTick_us = 1000;
  static constexpr std::uint64_t kSegment_us = 300'000;
  static constexpr std::uint64_t kLinkTimeout_us = 200'000;
  static constexpr std::size_t kQueue = 4;
  using Bytes = std::vector<std::uint8_t>;

  // What a test may look at and change.
  protocol::HelloReply identity;
  std::vector<FakeParameter> parameters;
  std::uint64_t device_us = 5'000'000;
  std::uint64_t last_request_us = device_us;
  protocol::Mode mode = protocol::Mode::disarmed;
  std::uint32_t latched = 0;
  std::map<std::uint8_t, int> executed;             // by message id
  std::vector<std::uint8_t> seen;                   // message ids of all good frames, repeats included
  std::vector<protocol::AddSegment> segments;       // accepted, ever
  std::optional<protocol::ErrorReply> refuse_next;  // whatever the next new request is
  std::uint16_t greatest_request_id = 0;
  bool mute_events = false;
  bool stopped = false;               // since it was armed
  std::uint16_t stops_by_others = 0;  // as it says in its status
  bool never_rests = false;           // Stop leaves it in the ramp
  bool staging_is_ours = false;       // false again once another session has opened the staging area

  FakeRobot() {
    identity.board = "fake";
    identity.robot_name = "astro";
    identity.unique_id.fill(7);
    identity.tick_hz = 1000;
    add_number("c_R", "1", protocol::ParameterKind::binary_scaled, -30, 1 << 29, 3 << 29, 1 << 30);
    add_number("c_L", "1", protocol::ParameterKind::binary_scaled, -30, 1 << 29, 3 << 29, 1 << 30);
    add_number("b", "m", protocol::ParameterKind::decimal_scaled, -9, 50'000'000, 2'000'000'000, 290'000'000);
    add_number("polarity", "1", protocol::ParameterKind::integer, 0, -1, 1, 1);
    add_number("robot_name", "", protocol::ParameterKind::text, 0, 1, 23, 0);
    parameters.back().value.active_text = parameters.back().value.staged_text = Text<24>("astro");
    identity.parameter_count = static_cast<std::uint16_t>(parameters.size());
  }

  /// Everything that the robot sends because of these bytes; each element is one frame.
  std::vector<Bytes> receive(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
      if (const auto body = framer_.push(byte)) take(*body);
    }
    return std::exchange(out_, {});
  }

  /// One tick of its clock; what it sends.
  std::vector<Bytes> tick() {
    device_us += kTick_us;
    if (moving() && device_us - last_request_us > kLinkTimeout_us) raise(Fault::link_lost);
    run_segment();
    if (telemetry_.period_ms != 0 && device_us >= next_telemetry_us_) send_telemetry();
    return std::exchange(out_, {});
  }

  bool moving() const { return mode == protocol::Mode::segment || mode == protocol::Mode::velocity; }

  void raise(Fault fault) {
    if (latched == 0) first_fault_ = fault;
    latched |= bit(fault);
    mode = protocol::Mode::fault;
    queue_.clear();
    event(protocol::FaultRaised{fault, device_us});
  }

  void restart() {
    device_us = 0;
    last_request_us = 0;
    mode = protocol::Mode::disarmed;
    queue_.clear();
    telemetry_ = {};
    last_reply_.clear();
    framer_ = {};
    staging_is_ours = false;
    revert();
    event(protocol::Booted{protocol::ResetCause::watchdog});
  }

  /// Frames that wait for the next receive() or tick().
  template <protocol::Message M>
  void event(const M& message) {
    if (!mute_events) push(message, 0);
  }

  FakeParameter& parameter(std::string_view name) {
    return *std::find_if(parameters.begin(), parameters.end(),
                         [&](const auto& p) { return p.info.name == name; });
  }

 private:
  protocol::Framer framer_;
  std::vector<Bytes> out_;
  std::deque<protocol::AddSegment> queue_;  // the running one first
  std::uint64_t segment_end_us_ = 0;
  protocol::SetTelemetry telemetry_;
  std::uint64_t next_telemetry_us_ = 0;
  protocol::Header last_request_;
  Bytes last_reply_;
  Fault first_fault_ = Fault::none;

  template <protocol::Message M>
  void push(const M& message, std::uint16_t request_id) {
    const protocol::Frame frame(message, request_id);
    out_.emplace_back(frame.bytes().begin(), frame.bytes().end());
  }

  void add_number(std::string_view name, std::string_view unit, protocol::ParameterKind kind,
                  std::int8_t exponent, std::int32_t minimum, std::int32_t maximum, std::int32_t standard) {
    FakeParameter p;
    p.info.id = p.value.id = static_cast<std::uint16_t>(10 * parameters.size() + 11);  // ids are not indices
    p.info.name = Text<24>(name);
    p.info.unit = Text<8>(unit);
    p.info.kind = kind;
    p.info.scale_exponent = exponent;
    p.info.minimum = minimum;
    p.info.maximum = maximum;
    p.info.default_value = p.value.active = p.value.staged = standard;
    parameters.push_back(p);
  }

  void revert() {
    for (auto& p : parameters) {
      p.value.staged = p.value.active;
      p.value.staged_text = p.value.active_text;
    }
  }

  void take(std::span<const std::uint8_t> body) {
    const protocol::Header header = *protocol::peek(body);
    seen.push_back(header.message_id);
    greatest_request_id = std::max(greatest_request_id, header.request_id);
    last_request_us = device_us;
    if (header == last_request_ && !last_reply_.empty()) return out_.push_back(last_reply_);
    ++executed[header.message_id];
    const std::size_t before = out_.size();
    if (refuse_next) {
      push(*std::exchange(refuse_next, std::nullopt), header.request_id);
    } else {
      bool known = false;
      protocol::Requests::visit([&]<class M>() {
        if (M::kId != header.message_id) return;
        known = true;
        if constexpr (std::is_same_v<typename M::Reply, protocol::Ack>) {
          const auto refused = carry_out(*protocol::decode<M>(body));
          refused ? push(*refused, header.request_id) : push(protocol::Ack{}, header.request_id);
        } else {
          answer(*protocol::decode<M>(body), header.request_id);
        }
      });
      if (!known) push(*no(protocol::ErrorCode::unknown_message), header.request_id);
    }
    last_request_ = header;
    last_reply_ = out_.size() > before ? out_.back() : Bytes{};
  }

  using Refusal = std::optional<protocol::ErrorReply>;
  static Refusal no(protocol::ErrorCode code, std::uint16_t detail = 0) {
    return protocol::ErrorReply{code, detail};
  }

  void answer(const protocol::Hello&, std::uint16_t id) {
    revert();
    staging_is_ours = false;
    push(identity, id);
  }
  void answer(const protocol::Ping&, std::uint16_t id) { push(protocol::Pong{device_us}, id); }
  void answer(const protocol::GetStatus&, std::uint16_t id) {
    protocol::Status status;
    status.device_time_us = device_us;
    status.mode = mode;
    status.latched_faults = latched;
    status.queued_segments = static_cast<std::uint16_t>(queue_.empty() ? 0 : queue_.size() - 1);
    status.running_tag = queue_.empty() ? std::uint16_t{0} : queue_.front().tag;
    status.stops_by_others = stops_by_others;
    push(status, id);
  }
  void answer(const protocol::GetFaults&, std::uint16_t id) {
    push(protocol::FaultReport{latched, latched != 0 ? first_fault_ : Fault::none, 0, 0}, id);
  }
  void answer(const protocol::GetFaultLog&, std::uint16_t id) {
    push(*no(protocol::ErrorCode::out_of_range), id);
  }
  void answer(const protocol::GetParameterInfo& request, std::uint16_t id) {
    if (request.index >= parameters.size()) return push(*no(protocol::ErrorCode::unknown_parameter), id);
    push(parameters[request.index].info, id);
  }
  void answer(const protocol::GetParameter& request, std::uint16_t id) {
    for (const auto& p : parameters) {
      if (p.info.id != request.id) continue;
      protocol::ParameterValue value = p.value;
      if (!staging_is_ours) {
        value.staged = value.active;
        value.staged_text = value.active_text;
      }
      return push(value, id);
    }
    push(*no(protocol::ErrorCode::unknown_parameter), id);
  }

  template <class M>
  Refusal carry_out(const M&) {
    return no(protocol::ErrorCode::unsupported);
  }
  Refusal carry_out(const protocol::Arm&) {
    if (latched != 0) return no(protocol::ErrorCode::faulted, static_cast<std::uint16_t>(first_fault_));
    mode = protocol::Mode::idle;
    stopped = false;
    return {};
  }
  Refusal carry_out(const protocol::Disarm&) {
    queue_.clear();
    if (mode != protocol::Mode::fault) mode = protocol::Mode::disarmed;
    return {};
  }
  Refusal carry_out(const protocol::EmergencyStop&) {
    raise(Fault::emergency_stop);
    return {};
  }
  Refusal carry_out(const protocol::Rest&) {
    if (mode == protocol::Mode::disarmed || stopped) return no(protocol::ErrorCode::not_armed);
    end_motion();
    return {};
  }
  Refusal carry_out(const protocol::Stop&) {
    stopped = true;
    end_motion();
    return {};
  }
  void end_motion() {
    if (!queue_.empty()) {
      event(protocol::SegmentDone{queue_.front().tag, protocol::SegmentOutcome::aborted, device_us});
    }
    queue_.clear();
    if (moving()) mode = never_rests ? protocol::Mode::stopping : protocol::Mode::idle;
  }
  Refusal carry_out(const protocol::Velocity&) {
    if (mode == protocol::Mode::disarmed || stopped) return no(protocol::ErrorCode::not_armed);
    mode = protocol::Mode::velocity;
    return {};
  }
  Refusal carry_out(const protocol::AddSegment& segment) {
    if (latched != 0) return no(protocol::ErrorCode::faulted, static_cast<std::uint16_t>(first_fault_));
    if (mode == protocol::Mode::disarmed || stopped) return no(protocol::ErrorCode::not_armed);
    if (queue_.size() == kQueue) return no(protocol::ErrorCode::queue_full);
    if (queue_.empty()) segment_end_us_ = device_us + kSegment_us;
    queue_.push_back(segment);
    segments.push_back(segment);
    mode = protocol::Mode::segment;
    return {};
  }
  Refusal carry_out(const protocol::StageParameter& request) {
    if (!staging_is_ours) return no(protocol::ErrorCode::staging_lost);
    for (auto& p : parameters) {
      if (p.info.id != request.id) continue;
      p.value.staged = request.value;
      p.value.staged_text = request.text;
      return {};
    }
    return no(protocol::ErrorCode::unknown_parameter, request.id);
  }
  Refusal carry_out(const protocol::CommitParameters&) {
    if (!staging_is_ours) return no(protocol::ErrorCode::staging_lost);
    const auto& sign = parameter("polarity");
    if (sign.value.staged == 0) return no(protocol::ErrorCode::invalid_parameter, sign.info.id);
    for (auto& p : parameters) {
      p.value.active = p.value.staged;
      p.value.active_text = p.value.staged_text;
    }
    return {};
  }
  Refusal carry_out(const protocol::RevertParameters&) {
    staging_is_ours = true;
    revert();
    return {};
  }
  Refusal carry_out(const protocol::DefaultParameters&) {
    staging_is_ours = true;
    for (auto& p : parameters) p.value.staged = p.info.default_value;
    return {};
  }
  Refusal carry_out(const protocol::SetTelemetry& request) {
    telemetry_ = request;
    next_telemetry_us_ = device_us;
    return {};
  }
  Refusal carry_out(const protocol::ClearFaults&) {
    latched = 0;
    mode = protocol::Mode::disarmed;
    return {};
  }

  void run_segment() {
    if (queue_.empty() || device_us < segment_end_us_) return;
    event(protocol::SegmentDone{queue_.front().tag, protocol::SegmentOutcome::completed, device_us});
    queue_.pop_front();
    segment_end_us_ = device_us + kSegment_us;
    if (queue_.empty()) mode = protocol::Mode::idle;
  }

  void send_telemetry() {
    next_telemetry_us_ += std::uint64_t{1000} * telemetry_.period_ms;
    protocol::Telemetry sample;
    sample.device_time_us = device_us;
    sample.fields = telemetry_.fields;
    event(sample);
  }
};

}  // namespace astro::test
