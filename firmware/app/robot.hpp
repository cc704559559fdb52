#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "common/base/version.hpp"
#include "common/protocol/codec.hpp"
#include "common/protocol/framer.hpp"
#include "common/protocol/messages.hpp"
#include "firmware/app/check_in.hpp"
#include "firmware/app/drive.hpp"
#include "firmware/app/event_log.hpp"
#include "firmware/app/fault_journal.hpp"
#include "firmware/app/flash_layout.hpp"
#include "firmware/app/parameter_desk.hpp"
#include "firmware/app/session.hpp"
#include "firmware/app/snapshot.hpp"
#include "firmware/app/tick_clock.hpp"
#include "hal/interface/board.hpp"

namespace astro {

/// The whole robot on a board: `tick()` from a 1 kHz interrupt, `poll()` from the main loop as often as it
/// goes.
///
/// The tick is control and safety; the main loop is the link. They share `drive_` only, and the main loop
/// touches it only while it holds the tick.
template <hal::Board Board>
class Robot {
 public:
  /// Outputs are off until a host arms the robot.
  [[gnu::cold]] explicit Robot(Board& board)
      : board_(board),
        drive_(ParameterSet::defaults()),
        flash_(board.flash()),
        desk_(flash_.parameters, typename Layout::Mark(flash_.log)),
        journal_(flash_.log, typename Layout::Mark(flash_.log)) {
    board_.motors().coast();
    const bool readable = desk_.load();
    drive_.configure(desk_.active());
    if (!readable) drive_.raise(Fault::parameters);
    const hal::ResetCause cause = board_.system().reset_cause();
    if (cause == hal::ResetCause::watchdog || cause == hal::ResetCause::fault) drive_.raise(Fault::watchdog);
    if (desk_.fell_back()) journal_.parameters_fell_back();
    events_.note({0, static_cast<std::uint16_t>(reset_cause()), HostEvent::Kind::booted});
  }

  void tick() {
    journal_.watch(drive_, ticks_.last_us(), battery_mv_);
    TickInput input;
    input.now_us = board_.clock().now_us();
    input.counts = board_.encoders().read();
    input.battery_mv = board_.battery().millivolts();
    input.driver_fault = board_.motors().fault();
    input.on_time = ticks_.advance(input.now_us);
    apply(drive_.advance(input), board_.motors());
    battery_mv_ = input.battery_mv;
    if (drive_.take_supervised()) check_in_.here(CheckIn::Task::supervisor);
    check_in_.here(CheckIn::Task::tick);
  }

  void poll() {
    for (int port = 0; port < kPorts; ++port) receive(port);
    plan();
    collect_events();
    journal_.write(board_, drive_);
    for (int port = 0; port < kPorts; ++port)
      if (tell(port)) stream(port);
    if (board_.system().host_wants_bootloader() && !drive_.armed()) reset_soon(Reset::bootloader);
    if (reset_wanted_ != Reset::none && board_.clock().now_us() >= reset_due_us_) reset();
    feed_watchdog();
  }

  const Drive& drive() const { return drive_; }
  const ParameterSet& parameters() const { return desk_.active(); }

 private:
  template <class Reply>
  using Answer = Result<Reply, protocol::ErrorReply>;
  using Ack = protocol::Ack;
  using ErrorCode = protocol::ErrorCode;
  /// Who a request comes from: the owner of a port, or an onlooker that shares it.
  struct Host {
    int port = kNobody;
    bool onlooker = false;
    bool operator==(const Host&) const = default;
  };
  static constexpr int kNobody = -1;
  enum class Reset : std::uint8_t { none, reboot, bootloader };
  static constexpr int kPorts = std::remove_reference_t<decltype(std::declval<Board&>().ports())>::kPorts;
  using Layout = FlashLayout<std::remove_reference_t<decltype(std::declval<Board&>().flash())>>;

  protocol::ResetCause reset_cause() {
    return static_cast<protocol::ResetCause>(board_.system().reset_cause());  // the same values in both
  }

  /// The profile of the next segment, made while the tick goes on.
  void plan() {
    Segment segment;
    std::uint8_t ticket = 0;
    {
      auto hold = board_.hold_tick();
      if (!drive_.wants_plan(segment, ticket)) return;
    }
    Trapezoid profile;
    Trapezoid::plan(segment, drive_.limits(), profile);
    auto hold = board_.hold_tick();
    drive_.take_plan(profile, ticket);
  }

  void feed_watchdog() {
    auto hold = board_.hold_tick();
    check_in_.here(CheckIn::Task::link);
    if (check_in_.complete()) board_.system().feed_watchdog();
  }

  // ---- from hosts

  void receive(int port) {
    std::array<std::uint8_t, 64> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init): read fills it
    // A bounded share per turn: a port that never falls silent must not starve the others.
    for (int turn = 0; turn < 8; ++turn) {
      const std::size_t count = board_.ports().read(port, bytes);
      for (std::size_t i = 0; i < count; ++i)
        if (const auto body = sessions_[port].framer.push(bytes[i])) answer(port, *body);
      if (count < bytes.size()) return;
    }
  }

  void answer(int port, std::span<const std::uint8_t> body) {
    Session& session = sessions_[port];
    const protocol::Header header = *protocol::peek(body);  // the framer drops what has no header
    if (header.request_id == 0) return;                     // that marks an event, and asks for nothing
    if (const auto again = session.answer(header); !again.empty()) {
      send(port, again);
      return;
    }
    asking_ = {port, protocol::from_onlooker(header)};
    note_host(header.message_id);
    bool known = false;
    protocol::Requests::visit([&]<protocol::Message M>() {
      if (M::kId != header.message_id) return;
      known = true;
      const auto request = protocol::decode<M>(body);
      if (request) {
        const auto reply = handle(port, *request);
        if (reply) note_driver(header.message_id);
        respond(port, header, reply);
      } else {
        respond(port, header, Answer<typename M::Reply>(error(ErrorCode::malformed)));
      }
    });
    if (!known) respond(port, header, Answer<Ack>(error(ErrorCode::unknown_message)));
  }

  /// Only the host that drives keeps a drive alive: not one that looks on, at another port or at the same
  /// one, and not one that says Hello where the driver was, which must have gone.
  void note_host(std::uint8_t message) {
    if (message == protocol::Hello::kId) {
      if (!asking_.onlooker && asking_.port == driver_.port) driver_ = {};
      return;
    }
    if (asking_ != driver_) return;
    auto hold = board_.hold_tick();
    drive_.host_seen();
  }

  /// The host that drives is the last whose Arm or motion request was taken. Pause and Resume come from
  /// anybody and leave the driver as it is: who resumes a path does not mean to keep it alive. If the driver
  /// is gone by then, the path ends by the command time-out.
  void note_driver(std::uint8_t message) {
    constexpr std::array kDriving{protocol::Arm::kId, protocol::Velocity::kId, protocol::WheelVoltage::kId,
                                  protocol::AddSegment::kId};
    if (std::find(kDriving.begin(), kDriving.end(), message) == kDriving.end()) return;
    driver_ = asking_;
    auto hold = board_.hold_tick();
    drive_.host_seen();
  }

  template <class Reply>
  void respond(int port, const protocol::Header& header, const Answer<Reply>& reply) {
    std::array<std::uint8_t, protocol::kMaxFrame> out;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    const std::size_t size =
        reply ? frame(*reply, header.request_id, out) : frame(reply.error(), header.request_id, out);
    send(port, std::span(out).first(size));
    if (!carried_out_anew(header.message_id)) sessions_[port].remember(header, std::span(out).first(size));
  }

  /// Whether a repeated request is carried out again in place of getting the same answer. A Pong is about now.
  /// Hello and what stops the robot may be carried out twice, and must never be taken for a request of long
  /// ago whose id has come round.
  static constexpr bool carried_out_anew(std::uint8_t message) {
    constexpr std::array kAnew{protocol::Ping::kId, protocol::Hello::kId, protocol::Stop::kId,
                               protocol::EmergencyStop::kId, protocol::Disarm::kId};
    return std::find(kAnew.begin(), kAnew.end(), message) != kAnew.end();
  }

  static protocol::ErrorReply error(ErrorCode code, std::uint16_t detail = 0) { return {code, detail}; }

  bool stands_idle() {
    auto hold = board_.hold_tick();
    return drive_.stands() && drive_.queued() == 0;
  }

  /// The answer to a request that needs an armed, fault-free robot and was not taken.
  protocol::ErrorReply not_ready() const {
    if (drive_.faults().any())
      return error(ErrorCode::faulted, static_cast<std::uint16_t>(drive_.faults().first()));
    if (drive_.state() == State::boot) return error(ErrorCode::busy);
    return error(drive_.armed() ? ErrorCode::queue_full : ErrorCode::not_armed);
  }

  Answer<protocol::HelloReply> handle(int port, const protocol::Hello& request) {
    if (request.protocol_version != protocol::kProtocolVersion)
      return error(ErrorCode::wrong_version, protocol::kProtocolVersion);
    if (!asking_.onlooker) begin_session(port);
    return protocol::HelloReply{.fw_major = kFirmwareVersion.major,
                                .fw_minor = kFirmwareVersion.minor,
                                .fw_patch = kFirmwareVersion.patch,
                                .unique_id = board_.system().unique_id(),
                                .board = Text<24>(board_.system().name()),
                                .robot_name = desk_.active().text(Param::robot_name),
                                .parameter_count = static_cast<std::uint16_t>(kParamCount),
                                .tick_hz = static_cast<std::uint16_t>(kTickHz)};
  }

  /// A new owner of the port: nothing of the one before it is left.
  void begin_session(int port) {
    sessions_[port].telemetry_period_us = 0;
    sessions_[port].forget();
    events_.skip(port);
    desk_.close(port);
  }

  Answer<protocol::Pong> handle(int, const protocol::Ping&) {
    return protocol::Pong{board_.clock().now_us()};
  }

  Answer<protocol::Status> handle(int, const protocol::GetStatus&) {
    std::uint32_t bad = 0;
    for (const Session& session : sessions_) bad += session.framer.counts().bad();
    auto hold = board_.hold_tick();
    return protocol::Status{.device_time_us = board_.clock().now_us(),
                            .mode = drive_.mode(),
                            .latched_faults = drive_.faults().mask(),
                            .queued_segments = static_cast<std::uint16_t>(drive_.queued()),
                            .running_tag = drive_.running_tag(),
                            .battery_mv = battery_mv_,
                            .tick_count = ticks_.count(),
                            .tick_overruns = ticks_.overruns(),
                            .tick_longest_us = ticks_.longest_us(),
                            .rx_bad_frames = bad,
                            .reset_cause = reset_cause()};
  }

  Answer<Ack> handle(int, const protocol::Arm&) {
    if (reset_wanted_ != Reset::none) return error(ErrorCode::busy);
    auto hold = board_.hold_tick();
    // Whoever arms becomes the driver, so nobody arms while another host's drive is under way or waits.
    if (asking_ != driver_ && (drive_.state() == State::driving || drive_.queued() != 0))
      return error(ErrorCode::moving);
    if (!drive_.arm()) return not_ready();
    return Ack{};
  }

  Answer<Ack> handle(int, const protocol::Disarm&) {
    disarm();
    return Ack{};
  }

  Answer<Ack> handle(int, const protocol::Stop&) {
    auto hold = board_.hold_tick();
    drive_.stop();
    return Ack{};
  }

  Answer<Ack> handle(int, const protocol::EmergencyStop&) {
    auto hold = board_.hold_tick();
    drive_.emergency_stop();
    board_.motors().coast();
    return Ack{};
  }

  Answer<Ack> handle(int, const protocol::Velocity& request) {
    drop_waiting();
    TwistRamp ramp = ramp_from_here();
    drive_.aim(ramp, {request.v_umps, request.omega_uradps});
    auto hold = board_.hold_tick();
    if (!drive_.drive_velocity(ramp)) return not_ready();
    return Ack{};
  }

  void drop_waiting() {
    auto hold = board_.hold_tick();
    drive_.drop_waiting();
  }
  TwistRamp ramp_from_here() {
    auto hold = board_.hold_tick();
    return drive_.ramp_from_here();
  }

  Answer<Ack> handle(int, const protocol::WheelVoltage& request) {
    const auto microvolts = [](std::int32_t mv) { return 1000 * clamp_abs<std::int32_t>(mv, 50'000); };
    auto hold = board_.hold_tick();
    if (drive_.armed() && drive_.driving() && drive_.mode() != protocol::Mode::wheels)
      return error(ErrorCode::moving);
    if (!drive_.drive_wheels({microvolts(request.left_mv), microvolts(request.right_mv)})) return not_ready();
    return Ack{};
  }

  Answer<Ack> handle(int, const protocol::AddSegment& request) {
    const bool moves = request.kind != protocol::SegmentKind::stop;
    const bool matches = (request.kind != protocol::SegmentKind::line || request.angle == 0) &&
                         (request.kind != protocol::SegmentKind::spin || request.length_nm == 0) &&
                         moves == (request.length_nm != 0 || request.angle != 0);
    const Segment segment{request.length_nm, request.angle, request.speed_umps, request.yaw_rate_uradps,
                          saturate32(request.dwell_ms)};
    Trapezoid profile;  // only to see whether it can be done
    if (!matches || request.speed_umps < 0 || request.yaw_rate_uradps < 0 ||
        !Trapezoid::plan(segment, make_limits(desk_.active()), profile))
      return error(ErrorCode::out_of_range);
    auto hold = board_.hold_tick();
    if (!drive_.add_segment(segment, request.tag)) return not_ready();
    return Ack{};
  }

  Answer<Ack> handle(int, const protocol::Pause&) {
    auto hold = board_.hold_tick();
    if (!drive_.armed()) return not_ready();
    if (!drive_.pause()) return error(ErrorCode::moving);
    return Ack{};
  }

  Answer<Ack> handle(int, const protocol::Resume&) {
    auto hold = board_.hold_tick();
    if (!drive_.armed()) return not_ready();
    drive_.resume();
    return Ack{};
  }

  Answer<Ack> handle(int, const protocol::SetPose& request) {
    // Half of what a position can hold, 4194 km: the robot does not drive over the edge from there.
    constexpr std::int64_t kFarthest = std::int64_t{1} << 62;
    for (const std::int64_t position : {request.x, request.y})
      if (position > kFarthest || position < -kFarthest) return error(ErrorCode::out_of_range);
    auto hold = board_.hold_tick();
    if (!drive_.stands()) return error(ErrorCode::moving);
    drive_.set_pose({request.x, request.y, Angle::from_raw(request.theta), 0});
    return Ack{};
  }

  Answer<protocol::ParameterInfo> handle(int, const protocol::GetParameterInfo& request) {
    return desk_.info(request.index);
  }
  Answer<protocol::ParameterValue> handle(int port, const protocol::GetParameter& request) {
    return desk_.value(port, request.id);
  }
  Answer<Ack> handle(int port, const protocol::StageParameter& request) { return desk_.stage(port, request); }

  Answer<Ack> handle(int port, const protocol::CommitParameters&) {
    // At rest only: the processor may stand still while the flash erases. With an empty queue only this loop
    // can set the robot moving.
    if (!stands_idle()) return error(ErrorCode::moving);
    const Answer<Ack> done = desk_.commit(port);
    if (done) put_in_force();
    auto hold = board_.hold_tick();
    if (!done && done.error().code == ErrorCode::flash_failed) drive_.raise(Fault::flash);
    return done;
  }

  Answer<Ack> handle(int port, const protocol::ApplyParameters&) {
    const Answer<Ack> done = desk_.apply(port, !stands_idle());
    if (done) put_in_force();
    return done;
  }
  /// Computed while the tick goes on, swapped in while it is held.
  [[gnu::cold]] void put_in_force() {
    const Drive::Configuration configuration(desk_.active());
    auto hold = board_.hold_tick();
    drive_.configure(configuration);
  }

  Answer<Ack> handle(int port, const protocol::RevertParameters&) {
    desk_.open(port);
    return Ack{};
  }
  Answer<Ack> handle(int port, const protocol::DefaultParameters&) {
    desk_.open_defaults(port);
    return Ack{};
  }

  Answer<Ack> handle(int port, const protocol::SetTelemetry& request) {
    if ((request.fields & ~protocol::Telemetry::kAll) != 0) return error(ErrorCode::out_of_range);
    Session& session = sessions_[port];
    session.telemetry_period_us = std::uint64_t{request.period_ms} * 1000;
    session.telemetry_fields = request.fields;
    session.telemetry_due_us = board_.clock().now_us();
    return Ack{};
  }

  Answer<protocol::FaultReport> handle(int, const protocol::GetFaults&) {
    auto hold = board_.hold_tick();
    const FaultLatch& faults = drive_.faults();
    return protocol::FaultReport{faults.mask(), faults.first(), faults.first_time_us(), faults.raised()};
  }

  Answer<Ack> handle(int, const protocol::ClearFaults&) {
    collect_events();
    std::uint32_t fresh = 0;
    {
      // What came since the last tick, or only just now, is logged and told all the same.
      auto hold = board_.hold_tick();
      journal_.watch(drive_, ticks_.last_us(), battery_mv_);
      fresh = drive_.faults().mask() & ~reported_faults_;
      if (!drive_.clear_faults()) return error(ErrorCode::moving);
      reported_faults_ = 0;
    }
    note_faults(fresh);
    return Ack{};
  }

  Answer<protocol::FaultLogEntry> handle(int, const protocol::GetFaultLog& request) {
    return journal_.entry(request.index);
  }

  Answer<Ack> handle(int, const protocol::Reboot&) {
    if (!drive_.at_rest()) return error(ErrorCode::moving);
    return reset_soon(Reset::reboot);
  }
  Answer<Ack> handle(int, const protocol::EnterBootloader&) {
    if (!drive_.at_rest()) return error(ErrorCode::moving);
    return reset_soon(Reset::bootloader);
  }

  /// Not at once: the answer has to leave the robot first. Until then nobody arms it any more.
  Ack reset_soon(Reset wanted) {
    constexpr std::uint64_t kFlush_us = 50'000;
    disarm();
    reset_wanted_ = wanted;
    reset_due_us_ = board_.clock().now_us() + kFlush_us;
    return {};
  }

  // ---- to hosts

  template <protocol::Message M>
  static std::size_t frame(const M& message, std::uint16_t request,
                           std::span<std::uint8_t, protocol::kMaxFrame> out) {
    std::array<std::uint8_t, protocol::kMaxBody> body;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    const std::size_t size = protocol::encode(message, request, body);
    return protocol::encode_frame(std::span(body).first(size), out);
  }

  // What a line takes is shared out by rank: an answer takes whatever room there is; an event leaves room for
  // the largest answer; telemetry leaves room for two of those and some events.
  static constexpr std::size_t kAnswerRoom = protocol::kMaxReplyFrame;
  static constexpr std::size_t kTelemetryLeaves = 2 * kAnswerRoom + 8 * protocol::kMaxEventFrame;

  /// Whole frames or nothing: a host that does not read loses frames, never halves of them.
  bool send(int port, std::span<const std::uint8_t> bytes, std::size_t leaves = 0) {
    if (board_.ports().room(port) < bytes.size() + leaves) return false;
    return board_.ports().write(port, bytes) == bytes.size();
  }

  template <protocol::Message M>
  bool send_unasked(int port, const M& event, std::size_t leaves) {
    std::array<std::uint8_t, protocol::kMaxFrame> out;  // NOLINT(cppcoreguidelines-pro-type-member-init)
    return send(port, std::span(out).first(frame(event, 0, out)), leaves);
  }

  bool send_event(int port, const HostEvent& event) {
    using protocol::SegmentOutcome;
    switch (event.kind) {
      case HostEvent::Kind::segment_started:
        return send_unasked(port, protocol::SegmentStarted{event.number, event.time_us}, kAnswerRoom);
      case HostEvent::Kind::segment_completed:
        return send_done(port, event, SegmentOutcome::completed);
      case HostEvent::Kind::segment_aborted:
        return send_done(port, event, SegmentOutcome::aborted);
      case HostEvent::Kind::fault_raised:
        return send_unasked(port, protocol::FaultRaised{static_cast<Fault>(event.number), event.time_us},
                            kAnswerRoom);
      case HostEvent::Kind::booted:
        return send_unasked(port, protocol::Booted{static_cast<protocol::ResetCause>(event.number)},
                            kAnswerRoom);
    }
    return true;
  }
  bool send_done(int port, const HostEvent& event, protocol::SegmentOutcome outcome) {
    return send_unasked(port, protocol::SegmentDone{event.number, outcome, event.time_us}, kAnswerRoom);
  }

  /// What the tick and the main loop have to tell. Faults come before the segments that they ended, so that a
  /// host knows why.
  void collect_events() {
    static_assert(
        static_cast<int>(HostEvent::Kind::segment_started) == static_cast<int>(SegmentEvent::Kind::started) &&
        static_cast<int>(HostEvent::Kind::segment_completed) ==
            static_cast<int>(SegmentEvent::Kind::completed) &&
        static_cast<int>(HostEvent::Kind::segment_aborted) == static_cast<int>(SegmentEvent::Kind::aborted));
    while (true) {
      SegmentEvent event;
      std::uint32_t fresh = 0;
      bool none = false;
      {
        auto hold = board_.hold_tick();
        fresh = drive_.faults().mask() & ~reported_faults_;
        reported_faults_ = drive_.faults().mask();
        none = drive_.events().empty();
        if (!none) event = drive_.events().pop();
      }
      note_faults(fresh);
      if (none) return;
      events_.note({event.time_us, event.tag, static_cast<HostEvent::Kind>(event.kind)});
    }
  }

  void note_faults(std::uint32_t fresh) {
    const std::uint64_t now_us = board_.clock().now_us();
    for (std::uint16_t i = 1; fresh != 0 && i < kFaultNames.size(); ++i)
      if ((fresh & bit(static_cast<Fault>(i))) != 0) events_.note({now_us, i, HostEvent::Kind::fault_raised});
  }

  /// The events that this port has not been told yet. False if some still wait for room.
  bool tell(int port) {
    if (const std::uint16_t missed = events_.missed(port); missed != 0) {
      if (!send_unasked(port, protocol::EventsMissed{missed}, kAnswerRoom)) return false;
      events_.forget_missed(port);
    }
    while (!events_.empty(port)) {
      if (!send_event(port, events_.front(port))) return false;
      events_.pop(port);
    }
    return true;
  }

  /// Telemetry, if it is due. What the line has no room to spare for is not sent later either.
  void stream(int port) {
    Session& session = sessions_[port];
    if (!session.telemetry_due(board_.clock().now_us())) return;
    protocol::Telemetry telemetry;
    {
      auto hold = board_.hold_tick();
      telemetry = snapshot(drive_, ticks_.last_us(), battery_mv_);
    }
    telemetry.fields = session.telemetry_fields;
    send_unasked(port, telemetry, kTelemetryLeaves);
    session.telemetry_sent(board_.clock().now_us());
  }

  void disarm() {
    auto hold = board_.hold_tick();
    drive_.disarm();
    board_.motors().coast();
  }

  void reset() {
    disarm();
    const Reset wanted = reset_wanted_;
    reset_wanted_ = Reset::none;
    if (wanted == Reset::bootloader && board_.system().enter_bootloader()) return;
    if (wanted == Reset::reboot) board_.system().reboot();
  }

  Board& board_;
  Drive drive_;  // what the tick uses comes first: instructions reach only so far from the begin of an object
  TickClock ticks_;
  CheckIn check_in_;
  Layout flash_;
  ParameterDesk<typename Layout::Parameters, typename Layout::Mark> desk_;
  std::array<Session, kPorts> sessions_{};
  EventLog<kPorts> events_;
  std::int32_t battery_mv_ = 0;
  std::uint32_t reported_faults_ = 0;
  Host asking_, driver_;
  Reset reset_wanted_ = Reset::none;
  std::uint64_t reset_due_us_ = 0;
  FaultJournal<typename Layout::Log, typename Layout::Mark> journal_;
};

}  // namespace astro
