#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/result.hpp"
#include "common/base/text.hpp"
#include "common/params/table.hpp"

namespace astro {

using ParamText = Text<24>;

namespace set_detail {

constexpr std::size_t count_texts(std::size_t rows) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows; ++i) count += kParamTable[i].kind == ParamKind::text ? 1 : 0;
  return count;
}

}  // namespace set_detail

/// One value for every row of the table. A value type: copies are staged, validated and committed.
///
/// Units   raw integers; the row's kind and exponent say what one unit of them is worth.
/// Errors  none here: a set may hold any value; validate() checks it as a whole.
/// Cost    4 bytes per row and 24 per text; get and set of a number are one array access.
class ParameterSet {
 public:
  /// Factory defaults.
  constexpr ParameterSet() {
    for (const ParamRow& row : kParamTable) {
      if (row.kind == ParamKind::text) {
        set_text(row.id, ParamText(row.default_text));
      } else {
        set(row.id, row.default_raw);
      }
    }
  }
  static constexpr ParameterSet defaults() { return {}; }

  /// Rows of every kind but text.
  constexpr std::int32_t get(Param id) const { return raw_[param_index(id)]; }
  constexpr void set(Param id, std::int32_t raw) { raw_[param_index(id)] = raw; }

  /// Text rows only.
  constexpr const ParamText& text(Param id) const { return texts_[text_index(id)]; }
  constexpr void set_text(Param id, const ParamText& text) { texts_[text_index(id)] = text; }

  constexpr bool operator==(const ParameterSet&) const = default;

 private:
  static constexpr std::size_t text_index(Param id) { return set_detail::count_texts(param_index(id)); }

  std::array<std::int32_t, kParamCount> raw_{};  // 0 where the row is a text
  std::array<ParamText, set_detail::count_texts(kParamCount)> texts_{};
};

/// The two sets differ in gains only, which may change while the wheels are driven.
bool only_gains_differ(const ParameterSet& a, const ParameterSet& b);

/// What validate() allows of the geometry: how far one count may move a wheel, and how many counts a turn of the robot
/// takes at least.
inline constexpr std::int64_t kShortestCount_nm = 1, kLongestCount_nm = 1'000'000'000 / 8;
inline constexpr std::int64_t kFewestCountsPerTurn = 16;

/// Refuses a set that the robot cannot run with, and names the row to change:
///   any row                a value outside its limits; a text too short, too long or not printable ASCII
///   a polarity             0
///   battery_high           not above battery_low, while neither is 0
///   over_speed             not above speed_limit: full speed would be a fault
///   counts_per_motor_rev   one count moves a wheel by kLongestCount_nm or more, or by less than kShortestCount_nm:
///                          it does not fit the odometry's fixed point
///   b                      kFewestCountsPerTurn counts of one wheel turn the robot once or more, about b or in a curve
///                          about b (1 + e): the heading is ambiguous
/// The rows are checked first, in table order. Integers only. Called when parameters change, not in the tick.
Result<void, Param> validate(const ParameterSet& set);

}  // namespace astro
