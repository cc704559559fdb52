#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "host/base/error.hpp"

namespace astro::robot {

using std::chrono::microseconds;

/// The way to the robot is gone, or the robot has stopped answering: what was under way may or may not have
/// happened. Everything else that can go wrong with a request leaves the robot in a known state.
class LinkLost : public Error {
 public:
  using Error::Error;
};

/// A stream of bytes to one robot, and the clock that belongs to it. A robot simulated in the same process
/// implements it too: there read() is what makes time pass, so whoever uses a Transport takes all its time
/// from now() and waits only by calling read().
///
/// Errors  every call throws LinkLost once the other end is gone; from then on only reopen() helps.
/// Threads one at a time.
class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  /// Hands over all bytes; waits while the other end takes none, but not for ever.
  virtual void write(std::span<const std::uint8_t> bytes) = 0;

  /// Moves what has arrived, at most into.size(); waits up to `timeout` for a first byte. 0: nothing came.
  virtual std::size_t read(std::span<std::uint8_t> into, microseconds timeout) = 0;

  /// Steady; from any origin.
  virtual microseconds now() const = 0;

  /// Lets go of the robot and opens the same address again, waiting up to `timeout` for it to be there. Bytes
  /// under way are lost. Throws Error, with a sentence that says why it cannot be opened.
  virtual void reopen(microseconds timeout) = 0;

  /// Why nothing comes although the line is there, where that is not the robot's doing; to be asked after a
  /// time-out, and may take half a second. Empty: not known.
  virtual std::string why_silent() { return {}; }

  /// The address as people know it: "/dev/ttyACM0".
  virtual const std::string& name() const = 0;
};

}  // namespace astro::robot
