#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "host/base/error.hpp"
#include "host/base/microseconds.hpp"

namespace astro::robot {

/// The connection to the robot is lost, or the robot has stopped answering: the request under way may or may
/// not have been carried out. After every other error of a request the robot's state is known.
class LinkLost : public Error {
 public:
  using Error::Error;
};

/// A stream of bytes to one robot, and the clock that belongs to it. A robot that is simulated in the same
/// process implements it too: there only read() lets time pass, so a user of a Transport takes all times from
/// now() and waits only by calling read().
///
/// Errors  every call throws LinkLost once the other end is gone; from then on only reopen() helps.
/// Threads one at a time.
class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  /// Sends all bytes; waits while the other end takes none, up to a time limit.
  virtual void write(std::span<const std::uint8_t> bytes) = 0;

  /// Returns the number of bytes read, at most into.size(); waits up to `timeout` for a first byte. 0: none
  /// came.
  virtual std::size_t read(std::span<std::uint8_t> into, microseconds timeout) = 0;

  /// Steady clock with any origin.
  virtual microseconds now() const = 0;

  /// Closes the connection and opens the same address again, waiting up to `timeout` for it to exist. Bytes
  /// under way are lost. Throws Error that says why it cannot be opened.
  virtual void reopen(microseconds timeout) = 0;

  /// Why no bytes come although the line is open, if the robot is not the reason; to be called after a time-
  /// out. May take half a second. Empty if the reason is not known.
  virtual Remark why_silent() { return {}; }

  /// The address as people know it: "/dev/ttyACM0".
  virtual const std::string& name() const = 0;
};

}  // namespace astro::robot
