#pragma once

#include <deque>
#include <optional>

#include "host/base/microseconds.hpp"
#include "host/robot/sharing/port_user.hpp"

namespace astro::robot {

/// Whose request may go to the robot next. Of the programs that do not drive (onlookers) only one request is
/// under way at a time, because the robot remembers one answer for all of them. They take turns in the order
/// in which they asked; a turn ends with the answer or at its deadline.
class Turns {
 public:
  /// A program that waits already keeps its place.
  void wait(SessionId id);
  /// The program neither waits nor has a turn any more.
  void end(SessionId id);
  /// Nobody waits and nobody has a turn any more.
  void clear();

  /// Takes the program that waits longest out of the queue; nothing while another one's turn lasts. The caller
  /// begins its turn, or asks for the next one if this one has nothing to send.
  std::optional<SessionId> next(microseconds now);
  void begin(SessionId id, microseconds deadline);

  /// It is this program's turn.
  bool has(SessionId id) const { return under_way_ == id; }
  /// When next() must be called even if no answer came; nothing if no turn lasts or nobody waits.
  std::optional<microseconds> deadline() const;

 private:
  std::deque<SessionId> waiting_;
  std::optional<SessionId> under_way_;
  microseconds deadline_{};  // of the one under way
};

}  // namespace astro::robot
