#include "common/params/parameter_set.hpp"

#include <algorithm>

namespace astro {
namespace {

static_assert(param_row(Param::wheel_diameter).exponent == -9 && param_row(Param::b).exponent == -9 &&
                  param_row(Param::c_R).exponent == -30 && param_row(Param::c_L).exponent == -30,
              "the rules below count in nanometres and Q2.30");
static_assert(param_row(Param::speed_limit).exponent == param_row(Param::over_speed).exponent);

bool text_is_good(const ParamRow& row, const ParamText& text) {
  const auto size = static_cast<std::int32_t>(text.size());
  const auto printable = [](char c) { return c >= ' ' && c <= '~'; };
  return size >= row.minimum_raw && size <= row.maximum_raw && std::ranges::all_of(text.view(), printable);
}

bool row_is_good(const ParamRow& row, const ParameterSet& set) {
  if (row.kind == ParamKind::text) return text_is_good(row, set.text(row.id));
  const std::int32_t raw = set.get(row.id);
  return raw >= row.minimum_raw && raw <= row.maximum_raw;
}

/// Wheel travel per count, rounded down to whole nanometres. Within the limits of the rows the largest
/// product is 355 * 1.5e9 nm * 1e6 < 2^63. 355 / 113 is pi plus less than 3e-7.
std::int64_t count_travel_nm(const ParameterSet& set, Param correction) {
  const std::int64_t diameter_nm =
      (std::int64_t{set.get(Param::wheel_diameter)} * set.get(correction) + (1 << 29)) >> 30;
  const std::int64_t circumference = 355 * diameter_nm * set.get(Param::gear_denominator) / 113;
  return circumference /
         (std::int64_t{set.get(Param::counts_per_motor_rev)} * set.get(Param::gear_numerator));
}

Result<void, Param> check_rows(const ParameterSet& set) {
  for (const ParamRow& row : kParamTable) {
    if (!row_is_good(row, set)) return row.id;
  }
  for (const Param polarity : {Param::motor_polarity_left, Param::motor_polarity_right,
                               Param::encoder_polarity_left, Param::encoder_polarity_right}) {
    if (set.get(polarity) == 0) return polarity;
  }
  return {};
}

Result<void, Param> check_geometry(const ParameterSet& set) {
  const std::int64_t right_nm = count_travel_nm(set, Param::c_R);
  const std::int64_t left_nm = count_travel_nm(set, Param::c_L);
  const auto [shortest_nm, longest_nm] = std::minmax(right_nm, left_nm);
  if (longest_nm >= kLongestCount_nm || shortest_nm < kShortestCount_nm) return Param::counts_per_motor_rev;
  // Where e is negative, a curve may turn about b (1 + e). The turn per count is travel over that in radians, and must be
  // less than 2 pi / kFewestCountsPerTurn.
  const std::int64_t least_of_b_30 = (std::int64_t{1} << 30) + std::min<std::int32_t>(set.get(Param::e), 0);
  const std::int64_t smallest_base_nm = (set.get(Param::b) * least_of_b_30) >> 30;
  if ((longest_nm + 1) * (kFewestCountsPerTurn / 2) * 113 >= smallest_base_nm * 355) return Param::b;
  return {};
}

}  // namespace

bool only_gains_differ(const ParameterSet& a, const ParameterSet& b) {
  constexpr std::array kGains{Param::kp,
                              Param::ki,
                              Param::kS_left,
                              Param::kV_left,
                              Param::kA_left,
                              Param::kS_right,
                              Param::kV_right,
                              Param::kA_right,
                              Param::k_sync,
                              Param::path_k_along,
                              Param::path_k_cross,
                              Param::path_k_heading,
                              Param::observer_bandwidth};
  ParameterSet other = b;
  for (const Param gain : kGains) other.set(gain, a.get(gain));
  return other == a;
}

Result<void, Param> validate(const ParameterSet& set) {
  if (const auto rows = check_rows(set); !rows) return rows;
  const std::int32_t low = set.get(Param::battery_low);
  const std::int32_t high = set.get(Param::battery_high);
  if (low != 0 && high != 0 && high <= low) return Param::battery_high;
  if (set.get(Param::over_speed) <= set.get(Param::speed_limit)) return Param::over_speed;
  return check_geometry(set);
}

}  // namespace astro
