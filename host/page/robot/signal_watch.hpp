#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "host/base/microseconds.hpp"
#include "host/page/robot/signals.hpp"
#include "host/robot/sharing/telemetry_stream.hpp"

namespace astro::page {

/// What one page watches, and the samples that wait for it.
///
/// Bounds  kMost samples wait; beyond that the oldest are dropped and counted.
class SignalWatch {
 public:
  static constexpr microseconds kBetweenBatches = std::chrono::milliseconds(25);
  static constexpr std::size_t kMost = 2000;  // two seconds at the fastest rate

  SignalWatch(std::vector<const Signal*> signals, std::uint16_t period_ms)
      : signals_(std::move(signals)),
        values_(signals_.size()),
        period_ms_(period_ms),
        request_({period_ms, fields()}) {}

  std::uint16_t period_ms() const { return period_ms_; }
  /// The groups of telemetry that it needs.
  std::uint32_t fields() const;

  /// Keeps the sample, unless a telemetry of this period has more than are wanted. One that came twice is kept once.
  void take(const protocol::Telemetry& telemetry, std::uint16_t stream_ms);
  /// The event with what waits, if it is time for one and anything waits.
  std::optional<nlohmann::json> batch(microseconds now);

 private:
  std::vector<const Signal*> signals_;
  std::vector<std::vector<double>> values_;  // by signal
  std::vector<double> times_s_;
  std::uint16_t period_ms_;
  robot::TelemetryRequest request_;
  std::optional<std::uint64_t> taken_us_;
  std::optional<microseconds> sent_at_;
  std::uint64_t missed_ = 0;
};

}  // namespace astro::page
