#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "host/formats/tables/rows.hpp"
#include "host/truth/files/track_problem.hpp"

/// Frame numbers in the first column of a table, and the times that they stand for.
namespace astro::truth {

class FrameNumbers {
 public:
  explicit FrameNumbers(char separator) : separator_(separator) {}

  /// Throws astro::Error with file, line and column if the cell is no whole number up to 10^12.
  std::int64_t take(std::string_view cell, const tables::Rows& rows);
  std::int64_t dropped() const { return dropped_; }  // numbers that were left out between two rows

 private:
  char separator_;
  std::optional<std::int64_t> last_;
  std::int64_t dropped_ = 0;
};

/// Throws astro::Error if the time is beyond 60 years. Precondition: rate_hz > 0.
std::int64_t frame_time_ns(std::int64_t frame, double rate_hz, const tables::Rows& rows);

}  // namespace astro::truth
