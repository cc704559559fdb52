#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace astro {

/// What the robot may do. One table says which event leads to which state, another what the bridges may do in
/// each state.
enum class State : std::uint8_t {
  boot,      // the tick has not shown yet that it comes at 1 kHz
  disarmed,  // nothing moves until somebody arms
  armed,     // at rest, ready to drive
  driving,   // a command or a path moves the wheels
  stopping,  // a ramp to rest is under way
  fault,     // something is latched
};
inline constexpr std::size_t kStates = 6;

/// What takes the robot from one state to another.
enum class Event : std::uint8_t {
  proven,  // ticks have come on time
  arm,     // a host lets the robot drive
  disarm,  // a host no longer lets it drive
  drive,   // there is something to drive
  stop,    // ramp to rest
  rest,    // the wheels have stopped, or are to stop at once
  fault,   // outputs off at once
  clear,   // a person has seen the latched faults
};
inline constexpr std::size_t kEvents = 8;

/// What the bridges may do.
enum class Permission : std::uint8_t { open, brake, drive };

namespace state_detail {

inline constexpr auto kNo = static_cast<State>(0xFF);  // refused: nothing changes

using enum State;
// clang-format off
inline constexpr std::array<std::array<State, kEvents>, kStates> kNext{{
    //              proven     arm       disarm     drive     stop      rest      fault   clear
    /* boot     */ {disarmed,  kNo,      boot,      kNo,      boot,     boot,     fault,  boot},
    /* disarmed */ {disarmed,  armed,    disarmed,  kNo,      disarmed, disarmed, fault,  disarmed},
    /* armed    */ {armed,     armed,    disarmed,  driving,  armed,    armed,    fault,  armed},
    /* driving  */ {driving,   driving,  disarmed,  driving,  stopping, armed,    fault,  kNo},
    /* stopping */ {stopping,  stopping, disarmed,  driving,  stopping, armed,    fault,  kNo},
    /* fault    */ {fault,     kNo,      fault,     kNo,      fault,    fault,    fault,  disarmed},
}};
// clang-format on

inline constexpr std::array<Permission, kStates> kPermission{Permission::open,  Permission::open,
                                                             Permission::brake, Permission::drive,
                                                             Permission::drive, Permission::open};

}  // namespace state_detail

/// False, and no change, if the state refuses the event.
constexpr bool advance(State& state, Event event) {
  const State next = state_detail::kNext[static_cast<std::size_t>(state)][static_cast<std::size_t>(event)];
  if (next == state_detail::kNo) return false;
  state = next;
  return true;
}

/// The one place that says when the motors may have power.
constexpr Permission permission(State state) {
  return state_detail::kPermission[static_cast<std::size_t>(state)];
}

/// A set of states.
using StateMask = std::uint8_t;
template <class... S>
constexpr StateMask states(S... state) {
  return static_cast<StateMask>(((1U << static_cast<unsigned>(state)) | ... | 0U));
}
constexpr bool within(State state, StateMask mask) {
  return (mask >> static_cast<unsigned>(state) & 1U) != 0;
}

}  // namespace astro
