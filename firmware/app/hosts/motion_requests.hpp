#pragma once

#include <cstdint>

#include "common/fixed/saturate.hpp"
#include "common/protocol/messages.hpp"
#include "firmware/app/hosts/host_sessions.hpp"
#include "firmware/app/hosts/restart.hpp"
#include "firmware/app/tick/control_tick.hpp"

namespace astro {

/// Carries out the requests that move the robot or stop it. Main loop only: what takes long is computed while
/// the tick runs, and only the result is handed over while the tick is held.
template <hal::Board Board>
class MotionRequests {
  using Ack = protocol::Ack;
  using Answer = protocol::Answer<Ack>;

 public:
  /// `parameters` is the set in force.
  MotionRequests(Board& board, SharedState<Board>& state, const ParameterSet& parameters,
                 const HostSessions<Board>& sessions, const Restart<Board>& restart)
      : board_(board), state_(state), parameters_(parameters), sessions_(sessions), restart_(restart) {}

  /// Ramps to rest and empties the queue.
  void stop() {
    end_waiting_segments();
    ramp_to_rest();
  }

  /// The host that arms drives from then on, so nobody can arm while a drive of another host is under way or
  /// waits. A host that may not know yet that another has stopped the robot is refused: its Arm may begin the next of many
  /// runs.
  Answer handle(const HostId& host, const protocol::Arm&) {
    if (restart_.scheduled()) return error(ErrorCode::busy);
    if (sessions_.has_unread_stops(host)) return error(ErrorCode::not_armed);
    const auto hold = board_.hold_tick();
    Drive& drive = state_.get(hold).drive;
    if (!sessions_.drives(host) && (drive.state() == State::driving || drive.queued() != 0))
      return error(ErrorCode::moving);
    if (!drive.arm()) return not_ready(drive);
    return Ack{};
  }

  Answer handle(const HostId&, const protocol::Disarm&) {
    disarm(board_, state_);
    return Ack{};
  }

  Answer handle(const HostId&, const protocol::Stop&) {
    stop();
    return Ack{};
  }

  Answer handle(const HostId& host, const protocol::Rest& request) {
    if (!permits(host, request) || !ready()) return not_permitted();
    stop();
    return Ack{};
  }

  Answer handle(const HostId&, const protocol::EmergencyStop&) {
    const auto hold = board_.hold_tick();
    state_.get(hold).drive.emergency_stop();
    board_.motors().coast();
    return Ack{};
  }

  Answer handle(const HostId& host, const protocol::Velocity& request) {
    if (!permits(host, request)) return not_permitted();
    end_waiting_segments();
    TwistRamp ramp = ramp_from_here();
    Drive::aim(ramp, {request.v_umps, request.omega_uradps}, make_limits(parameters_));
    const auto hold = board_.hold_tick();
    Drive& drive = state_.get(hold).drive;
    if (!drive.drive_velocity(ramp)) return not_ready(drive);
    return Ack{};
  }

  Answer handle(const HostId& host, const protocol::WheelVoltage& request) {
    if (!permits(host, request)) return not_permitted();
    const auto microvolts = [](std::int32_t mv) { return 1000 * clamp_abs<std::int32_t>(mv, 50'000); };
    const auto hold = board_.hold_tick();
    Drive& drive = state_.get(hold).drive;
    if (drive.armed() && drive.gives_power() && drive.mode() != protocol::Mode::wheels)
      return error(ErrorCode::moving);
    if (!drive.drive_wheels({microvolts(request.left_mv), microvolts(request.right_mv)}))
      return not_ready(drive);
    return Ack{};
  }

  Answer handle(const HostId& host, const protocol::AddSegment& request) {
    if (!permits(host, request)) return not_permitted();
    const bool moves = request.kind != protocol::SegmentKind::stop;
    const bool matches = (request.kind != protocol::SegmentKind::line || request.angle == 0) &&
                         (request.kind != protocol::SegmentKind::spin || request.length_nm == 0) &&
                         moves == (request.length_nm != 0 || request.angle != 0);
    const Segment segment{request.length_nm, request.angle, request.speed_umps, request.yaw_rate_uradps,
                          saturate32(request.dwell_ms)};
    Trapezoid profile;  // only to see whether the segment can be driven
    if (!matches || request.speed_umps < 0 || request.yaw_rate_uradps < 0 ||
        !Trapezoid::plan(segment, make_limits(parameters_), profile))
      return error(ErrorCode::out_of_range);
    const auto hold = board_.hold_tick();
    Drive& drive = state_.get(hold).drive;
    if (!drive.add_segment(segment, request.tag)) return not_ready(drive);
    return Ack{};
  }

  Answer handle(const HostId&, const protocol::Pause&) {
    if (drives_without_path()) ramp_to_rest();
    const auto hold = board_.hold_tick();
    Drive& drive = state_.get(hold).drive;
    if (!drive.pause()) return not_ready(drive);
    return Ack{};
  }

  Answer handle(const HostId& host, const protocol::Resume& request) {
    if (!permits(host, request)) return not_permitted();
    const auto hold = board_.hold_tick();
    Drive& drive = state_.get(hold).drive;
    if (!drive.armed()) return not_ready(drive);
    drive.resume();
    return Ack{};
  }

  Answer handle(const HostId&, const protocol::SetPose& request) {
    // Half of what a position can hold, 4194 km: the robot cannot drive beyond the range from there.
    constexpr std::int64_t kFarthest = std::int64_t{1} << 62;
    for (const std::int64_t position : {request.x, request.y})
      if (position > kFarthest || position < -kFarthest) return error(ErrorCode::out_of_range);
    const auto hold = board_.hold_tick();
    auto& state = state_.get(hold);
    if (!state.drive.stopped_without_power()) return error(ErrorCode::moving);
    state.set_pose({request.x, request.y, Angle::from_raw(request.theta), 0});
    return Ack{};
  }

 private:
  using ErrorCode = protocol::ErrorCode;

  [[gnu::noinline]] void ramp_to_rest() {
    TwistRamp ramp = begun_ramp_to_rest();
    ramp.set_target({});
    const auto hold = board_.hold_tick();
    state_.get(hold).drive.stop(ramp);
  }
  TwistRamp begun_ramp_to_rest() {
    const auto hold = board_.hold_tick();
    return state_.get(hold).drive.ramp_to_rest();
  }
  bool drives_without_path() {
    const auto hold = board_.hold_tick();
    const Drive& drive = state_.get(hold).drive;
    return drive.state() == State::driving && drive.mode() != protocol::Mode::segment;
  }
  void end_waiting_segments() {
    const auto hold = board_.hold_tick();
    state_.get(hold).drive.drop_waiting();
  }
  TwistRamp ramp_from_here() {
    const auto hold = board_.hold_tick();
    return state_.get(hold).drive.ramp_from_here();
  }

  static protocol::ErrorReply error(ErrorCode code, std::uint16_t detail = 0) { return {code, detail}; }

  template <protocol::Request M>
  bool permits(const HostId& host, const M&) const {
    return sessions_.permits(host, M::kId);
  }
  bool ready() {
    const auto hold = board_.hold_tick();
    const Drive& drive = state_.get(hold).drive;
    return drive.armed() && !drive.faults().any();
  }
  [[gnu::cold]] protocol::ErrorReply not_permitted() {
    const auto hold = board_.hold_tick();
    const Drive& drive = state_.get(hold).drive;
    return drive.armed() && !drive.faults().any() ? error(ErrorCode::not_armed) : not_ready(drive);
  }

  /// Why a request was refused that needs an armed robot without a latched fault.
  static protocol::ErrorReply not_ready(const Drive& drive) {
    if (drive.faults().any())
      return error(ErrorCode::faulted, static_cast<std::uint16_t>(drive.faults().first()));
    if (drive.state() == State::boot) return error(ErrorCode::busy);
    return error(drive.armed() ? ErrorCode::queue_full : ErrorCode::not_armed);
  }

  Board& board_;
  SharedState<Board>& state_;
  const ParameterSet& parameters_;
  const HostSessions<Board>& sessions_;
  const Restart<Board>& restart_;
};

}  // namespace astro
