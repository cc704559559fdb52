#pragma once

#include <type_traits>
#include <utility>

namespace astro {

/// A value that the control tick and the main loop share. The tick interrupts the main loop anywhere, so the
/// main loop must keep the tick away while it touches the value. The compiler checks that it does:
///
///   const auto hold = board.hold_tick();
///   shared.get(hold).drive.stop();        // compiles only with the token in hand
///
/// `Hold` is the token, the guard that hal::Board::hold_tick() returns: the tick does not run while it lives.
/// `Tick` is the one class whose code runs in the interrupt and needs no token.
///
/// A temporary guard is refused: it would die at the end of the expression, and a reference to the value
/// would outlive it. What the compiler cannot see is a reference that leaves the guard's scope: do not keep
/// one.
///
/// Cost    none.
template <class T, class Hold, class Tick>
class Shared {
  static_assert(std::is_class_v<Hold> && !std::is_copy_constructible_v<Hold>,
                "the token must be a guard that nobody can copy and keep");

 public:
  template <class... Arguments>
  explicit Shared(Arguments&&... arguments) : value_(std::forward<Arguments>(arguments)...) {}
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;

  T& get(const Hold&) { return value_; }
  const T& get(const Hold&) const { return value_; }
  T& get(const Hold&&) = delete;
  const T& get(const Hold&&) const = delete;

 private:
  friend Tick;
  T& of_tick() { return value_; }

  T value_;
};

}  // namespace astro
