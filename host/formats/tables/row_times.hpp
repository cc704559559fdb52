#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/sample_times.hpp"

/// What is odd about the times of a table's rows, and what can be done about it.
namespace astro::tables {

/// Times of rows that were written with too few digits, as whole seconds with fifty rows in each, and are spread.
struct SpreadTimes {
  std::vector<std::int64_t> times_ns;  // strictly increasing
  double step_s = 0, rows_in_step = 0;
};

/// Spreads the rows of each time evenly until the next one. The rows of the first time come at the end of it and those of the
/// last at its beginning, because the recording began and ended within them. Nothing unless nearly all times between have the
/// same number of rows, give or take a fifth or one. `times_ns` must not decrease.
std::optional<SpreadTimes> spread_times(std::vector<std::int64_t> times_ns);

/// A row with a time before that of the row above.
struct TimeFall {
  int line = 0;
  double from_s = 0, to_s = 0;

  std::string text() const;  // "the time falls from 3.000 s to 2.000 s"
};

/// What came of the times of the rows.
struct SettledTimes {
  std::optional<TimeFall> fall;       // which no set clock explains: the times are of no use
  bool too_coarse = false;            // many rows share a time, and not evenly: likewise
  std::optional<SpreadTimes> spread;  // many shared one evenly, and were spread
};

/// Watches the times of successive rows.
class RowTimes {
 public:
  /// `changed`: the row has other values than the row above.
  void take(std::int64_t time_ns, int line, bool changed);

  /// Mends the times of the samples, one for each row that was taken: spreads those that many rows share because they have too
  /// few digits, or takes back what a clock or a link did (host/base/sample_times.hpp), with remarks about the stream `what`.
  /// Times that a few rows share stay as they are.
  template <class Sample>
  SettledTimes settle(std::vector<Sample>& samples, const std::string& what,
                      std::vector<Remark>& remarks) const {
    std::vector<std::int64_t> times_ns = times_of(samples);
    SettledTimes settled = settle_times(times_ns, what, remarks);
    set_times(samples, times_ns);
    return settled;
  }

  /// The part of the rows with new values that repeat a time, in whole percent.
  std::string percent_repeated() const;

 private:
  SettledTimes settle_times(std::vector<std::int64_t>& times_ns, const std::string& what,
                            std::vector<Remark>& remarks) const;
  bool few_repeat() const;

  std::optional<std::int64_t> last_ns_;
  std::size_t rows_ = 0, changed_ = 0, changed_repeated_ = 0;
  std::vector<std::pair<std::size_t, int>> falls_;  // their rows, from 0, and lines
};

}  // namespace astro::tables
