#pragma once

#include <cstdint>

#include "common/base/version.hpp"
#include "common/protocol/messages.hpp"
#include "firmware/app/hosts/fault_journal.hpp"
#include "firmware/app/hosts/flash_layout.hpp"
#include "firmware/app/hosts/host_events.hpp"
#include "firmware/app/hosts/host_sessions.hpp"
#include "firmware/app/hosts/motion_requests.hpp"
#include "firmware/app/hosts/parameter_service.hpp"
#include "firmware/app/hosts/restart.hpp"
#include "firmware/app/tick/control_tick.hpp"

namespace astro {

/// Carries out the requests of hosts: `handle(host, request)` returns the reply, or the reason why the
/// request was refused and has changed nothing. Main loop only.
template <hal::Board Board>
class RequestHandler {
  using Ack = protocol::Ack;
  using ErrorCode = protocol::ErrorCode;
  using Layout = FlashLayout<std::remove_reference_t<decltype(std::declval<Board&>().flash())>>;
  template <class Reply>
  using Answer = protocol::Answer<Reply>;

 public:
  using Parameters = ParameterService<typename Layout::Parameters, typename Layout::Mark>;
  using Journal = FaultJournal<typename Layout::Log, typename Layout::Mark>;

  RequestHandler(Board& board, SharedState<Board>& state, Parameters& parameters, const Journal& journal,
                 HostSessions<Board>& sessions, HostEvents<Board>& events, Restart<Board>& restart)
      : board_(board),
        state_(state),
        parameters_(parameters),
        journal_(journal),
        sessions_(sessions),
        events_(events),
        restart_(restart),
        motion_(board, state, parameters.active(), sessions, restart) {}

  template <protocol::Request M>
  requires requires(MotionRequests<Board>& motion, const HostId& host, const M& request) {
    motion.handle(host, request);
  }
  Answer<Ack> handle(const HostId& host, const M& request) { return motion_.handle(host, request); }

  [[gnu::cold]] Answer<protocol::HelloReply> handle(const HostId& host, const protocol::Hello& request) {
    // The program that drove has gone, and with a time-out of zero nothing else would stop the robot.
    if (!host.onlooker && sessions_.end_drive(host.port)) motion_.stop();
    if (request.protocol_version != protocol::kProtocolVersion)
      return error(ErrorCode::wrong_version, protocol::kProtocolVersion);
    if (!host.onlooker) begin_session(host.port);
    return protocol::HelloReply{.fw_major = kFirmwareVersion.major,
                                .fw_minor = kFirmwareVersion.minor,
                                .fw_patch = kFirmwareVersion.patch,
                                .unique_id = board_.system().unique_id(),
                                .board = Text<24>(board_.system().name()),
                                .robot_name = parameters_.active().text(Param::robot_name),
                                .parameter_count = static_cast<std::uint16_t>(kParamCount),
                                .tick_hz = static_cast<std::uint16_t>(kTickHz)};
  }

  Answer<protocol::Pong> handle(const HostId&, const protocol::Ping&) {
    return protocol::Pong{board_.clock().now_us()};
  }

  Answer<protocol::Status> handle(const HostId& host, const protocol::GetStatus&) {
    const std::uint32_t bad_frames = sessions_.bad_frames();
    const std::uint16_t stops_by_others = sessions_.read_stops(host);
    const auto hold = board_.hold_tick();
    const auto& state = state_.get(hold);
    return protocol::Status{.device_time_us = board_.clock().now_us(),
                            .mode = state.drive.mode(),
                            .latched_faults = state.drive.faults().mask(),
                            .queued_segments = static_cast<std::uint16_t>(state.drive.queued()),
                            .running_tag = state.drive.running_tag(),
                            .battery_mv = state.battery_mv,
                            .tick_count = state.clock.count(),
                            .tick_overruns = state.clock.overruns(),
                            .tick_longest_us = state.clock.longest_us(),
                            .rx_bad_frames = bad_frames,
                            .reset_cause = on_the_wire(board_.system().reset_cause()),
                            .stops_by_others = stops_by_others};
  }

  Answer<protocol::ParameterInfo> handle(const HostId&, const protocol::GetParameterInfo& request) {
    return parameters_.info(request.index);
  }
  Answer<protocol::ParameterValue> handle(const HostId& host, const protocol::GetParameter& request) {
    return parameters_.value(host.port, request.id);
  }
  Answer<Ack> handle(const HostId& host, const protocol::StageParameter& request) {
    return parameters_.stage(host.port, request);
  }

  /// Refused unless the wheels have stopped: the processor may stand still while the flash erases. With an
  /// empty queue nothing but this loop can set the robot moving.
  Answer<Ack> handle(const HostId& host, const protocol::CommitParameters&) {
    if (!stopped_without_work()) return error(ErrorCode::moving);
    const Answer<Ack> done = parameters_.commit(host.port);
    if (done) configure_drive();
    if (!done && done.error().code == ErrorCode::flash_failed) {
      const auto hold = board_.hold_tick();
      state_.get(hold).drive.raise(Fault::flash);
    }
    return done;
  }

  Answer<Ack> handle(const HostId& host, const protocol::ApplyParameters&) {
    const Answer<Ack> done = parameters_.apply(host.port, !stopped_without_work());
    if (done) configure_drive();
    return done;
  }

  Answer<Ack> handle(const HostId& host, const protocol::RevertParameters&) {
    parameters_.open(host.port);
    return Ack{};
  }
  Answer<Ack> handle(const HostId& host, const protocol::DefaultParameters&) {
    parameters_.open_defaults(host.port);
    return Ack{};
  }

  Answer<Ack> handle(const HostId& host, const protocol::SetTelemetry& request) {
    if ((request.fields & ~protocol::Telemetry::kAll) != 0) return error(ErrorCode::out_of_range);
    Session& session = sessions_.session(host.port);
    session.telemetry_period_us = std::uint64_t{request.period_ms} * 1000;
    session.telemetry_fields = request.fields;
    session.telemetry_due_us = board_.clock().now_us();
    return Ack{};
  }

  Answer<protocol::FaultReport> handle(const HostId&, const protocol::GetFaults&) {
    const auto hold = board_.hold_tick();
    const FaultLatch& faults = state_.get(hold).drive.faults();
    return protocol::FaultReport{faults.mask(), faults.first(), faults.first_time_us(), faults.raised()};
  }

  Answer<Ack> handle(const HostId&, const protocol::ClearFaults&) {
    if (!events_.clear_faults()) return error(ErrorCode::moving);
    return Ack{};
  }

  Answer<protocol::FaultLogEntry> handle(const HostId&, const protocol::GetFaultLog& request) {
    return journal_.entry(request.index);
  }

  Answer<Ack> handle(const HostId&, const protocol::Reboot&) { return restart(Restart<Board>::Kind::reboot); }
  Answer<Ack> handle(const HostId&, const protocol::EnterBootloader&) {
    return restart(Restart<Board>::Kind::bootloader);
  }

 private:
  static protocol::ErrorReply error(ErrorCode code, std::uint16_t detail = 0) { return {code, detail}; }

  /// A new program has opened the port: nothing that belonged to the one before it is left.
  void begin_session(int port) {
    sessions_.session(port).telemetry_period_us = 0;
    sessions_.session(port).forget();
    events_.skip(port);
    parameters_.close(port);
  }

  bool stopped_without_work() {
    const auto hold = board_.hold_tick();
    const Drive& drive = state_.get(hold).drive;
    return drive.stopped_without_power() && drive.queued() == 0;
  }

  /// Hands the parameters in force to the drive. Their meaning is computed while the tick runs.
  [[gnu::cold]] void configure_drive() {
    const typename TickState<hal::HasGyro<Board>>::Configuration configuration(parameters_.active());
    const auto hold = board_.hold_tick();
    state_.get(hold).configure(configuration);
  }

  [[gnu::cold]] Answer<Ack> restart(typename Restart<Board>::Kind kind) {
    if (gives_power()) return error(ErrorCode::moving);
    restart_.schedule(kind);
    return Ack{};
  }
  bool gives_power() {
    const auto hold = board_.hold_tick();
    return state_.get(hold).drive.gives_power();
  }

  Board& board_;
  SharedState<Board>& state_;
  Parameters& parameters_;
  const Journal& journal_;
  HostSessions<Board>& sessions_;
  HostEvents<Board>& events_;
  Restart<Board>& restart_;
  MotionRequests<Board> motion_;
};

}  // namespace astro
