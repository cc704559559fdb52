#pragma once

#include "firmware/app/hosts/host_events.hpp"
#include "firmware/app/hosts/host_sessions.hpp"
#include "firmware/app/hosts/request_handler.hpp"
#include "firmware/app/hosts/restart.hpp"
#include "firmware/app/tick/control_tick.hpp"

namespace astro {

/// The whole robot on a board. Call `tick()` from a 1 kHz interrupt and `poll()` from the main loop, again
/// and again.
///
/// The tick is control and safety; the main loop serves the hosts and writes the flash. What both use is in
/// one object (TickState), which the main loop can only reach while it holds the tick (Shared).
template <hal::Board Board>
class Robot {
 public:
  /// The outputs stay off until a host arms the robot.
  [[gnu::cold]] explicit Robot(Board& board)
      : board_(board),
        tick_(board),
        flash_(board.flash()),
        parameters_(flash_.parameters, typename Layout::Mark(flash_.log)),
        journal_(flash_.log, typename Layout::Mark(flash_.log)),
        sessions_(board, tick_.state()),
        events_(board, tick_.state()),
        restart_(board, tick_.state()),
        requests_(board, tick_.state(), parameters_, journal_, sessions_, events_, restart_) {
    board_.motors().coast();
    const bool readable = parameters_.load();
    const hal::ResetCause cause = board_.system().reset_cause();
    const typename TickState<hal::HasGyro<Board>>::Configuration configuration(parameters_.active());
    {
      const auto hold = board_.hold_tick();
      auto& state = tick_.state().get(hold);
      state.configure(configuration);
      if (!readable) state.drive.raise(Fault::parameters);
      if (cause == hal::ResetCause::watchdog || cause == hal::ResetCause::fault)
        state.drive.raise(Fault::watchdog);
      // The robot runs with the parameters before those that were damaged. Logged once in a row of starts.
      if (parameters_.fell_back() && !journal_.newest_is_of_a_start(Fault::flash))
        state.faults.note_at_start(Fault::flash);
    }
    events_.note_start(on_the_wire(cause));
  }

  void tick() { tick_.run(); }

  void poll() {
    for (int port = 0; port < kPorts; ++port) sessions_.receive(port, requests_);
    plan_next_segment();
    events_.collect();
    journal_.write(board_, tick_.state());
    for (int port = 0; port < kPorts; ++port)
      if (events_.send(port)) sessions_.send_telemetry(port);
    restart_.poll();
    feed_watchdog();
  }

  const Drive& drive(const hal::TickHold<Board>& hold) const { return tick_.state().get(hold).drive; }
  const Drive& drive(const hal::TickHold<Board>&&) const = delete;  // a reference would outlive the hold
  const ParameterSet& parameters() const { return parameters_.active(); }

 private:
  static constexpr int kPorts = std::remove_reference_t<decltype(std::declval<Board&>().ports())>::kPorts;
  using Layout = FlashLayout<std::remove_reference_t<decltype(std::declval<Board&>().flash())>>;

  /// The profile takes roots and divisions, so it is made while the tick runs.
  void plan_next_segment() {
    Segment segment;
    std::uint8_t ticket = 0;
    {
      const auto hold = board_.hold_tick();
      if (!tick_.state().get(hold).drive.wants_plan(segment, ticket)) return;
    }
    Trapezoid profile;
    Trapezoid::plan(segment, make_limits(parameters_.active()), profile);
    const auto hold = board_.hold_tick();
    tick_.state().get(hold).drive.take_plan(profile, ticket);
  }

  void feed_watchdog() {
    const auto hold = board_.hold_tick();
    CheckIn& check_in = tick_.state().get(hold).check_in;
    check_in.here(CheckIn::Task::link);
    if (check_in.complete()) board_.system().feed_watchdog();
  }

  Board& board_;
  ControlTick<Board> tick_;
  Layout flash_;
  typename RequestHandler<Board>::Parameters parameters_;
  typename RequestHandler<Board>::Journal journal_;
  HostSessions<Board> sessions_;
  HostEvents<Board> events_;
  Restart<Board> restart_;
  RequestHandler<Board> requests_;
};

}  // namespace astro
