#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/truth/scanners/rplidar_turns.hpp"

namespace astro::truth::rplidar {

/// Why a scanner gives no scans. The first value is its port.
enum class ScannerProblem {
  silent,         // nothing comes from the port; then the speeds that were tried
  not_a_scanner,  // bytes come, but no answer in any of these speeds
  unhealthy,      // then the code that it reports
  refuses,        // it does not begin to scan
  stopped,        // no measurement comes any more; then for how many seconds
  damaged,        // most of the bytes are
  unplugged
};

/// The serial line to a scanner, and the clock that belongs to it.
///
/// Errors  every call throws astro::Error with ScannerProblem::unplugged once the device is gone.
class Line {
 public:
  Line() = default;
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  virtual ~Line() = default;

  /// Opens the port, or closes it and opens it anew, at this speed. Throws astro::Error that says why it cannot be opened.
  virtual void open(unsigned baud) = 0;
  virtual void write(ByteView bytes) = 0;
  /// Waits up to `timeout` for a first byte; returns the number of bytes, 0 if none came.
  virtual std::size_t read(std::span<std::uint8_t> into, std::chrono::microseconds timeout) = 0;
  /// Lets the motor of an A1 run, which hangs at the line DTR.
  virtual void run_motor(bool on) = 0;
  virtual std::chrono::microseconds now() const = 0;
  virtual const std::string& name() const = 0;
};

/// Makes an RPLIDAR scan: A1, A2, A3, C1 and what else answers as they do.
///
/// Start  the constructor finds the speed at which the scanner answers, asks how it is and resets it once if it is not well, lets
///        its motor run and starts the scan, in the faster of the two modes that every model has. It takes about a second, and a
///        few at a port where nobody answers.
/// Run    poll() reads. Lost bytes cost the turn in which they were lost.
/// End    the destructor stops scan and motor.
/// Errors astro::Error with a ScannerProblem.
class Driver {
 public:
  explicit Driver(std::unique_ptr<Line> line);
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;
  ~Driver();

  /// Waits up to `timeout` for bytes and returns the scans that they complete; their times are on the line's clock. Throws if
  /// nothing has come for three seconds, or if most of what came in a second was damaged.
  std::vector<lidar::Scan> poll(std::chrono::microseconds timeout);

  const Info& info() const { return info_; }
  unsigned baud() const { return baud_; }
  /// Bytes that made no sense, since the scan began.
  std::int64_t skipped_bytes() const { return nodes_->skipped_bytes(); }

 private:
  void find_speed();
  bool answers_at(unsigned baud);
  void require_health();
  SampleTimes ask_sample_times();
  void start_scan();
  void drain();
  void send(Command command, ByteView payload = {});
  std::optional<Bytes> ask(Command command, AnswerType type, std::size_t bytes,
                           std::chrono::microseconds timeout);
  std::optional<Descriptor> await_descriptor(std::span<const AnswerType> types,
                                             std::chrono::microseconds timeout);
  bool read_more(std::chrono::microseconds deadline);
  void watch_damage(std::size_t bytes);
  [[noreturn]] void fail(ScannerProblem problem, const std::string& sentence,
                         const std::string& value = "") const;

  std::unique_ptr<Line> line_;
  Info info_;
  unsigned baud_ = 0;
  bool heard_ = false;  // any bytes
  Bytes received_;      // not yet understood
  std::optional<NodeReader> nodes_;
  std::optional<TurnAssembler> turns_;
  std::chrono::microseconds heard_at_{}, counting_from_{};
  std::int64_t bytes_ = 0, skipped_before_ = 0;  // since counting_from_
};

}  // namespace astro::truth::rplidar
