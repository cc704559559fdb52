#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// The description of one parameter, and the consteval functions that the table is written with.
///
/// Defaults and limits are written as real numbers in the row's unit. The compiler turns them into raw
/// integers, so no floating point reaches the robot. A number that does not fit its scale does not compile.
namespace astro {

enum class Param : std::uint16_t;

/// How to read a raw value. The numbers are those of protocol::ParameterKind, which also has 3 for a flag: no
/// row has been one so far.
enum class ParamKind : std::uint8_t {
  binary_scaled = 0,   // value = raw * 2^exponent
  decimal_scaled = 1,  // value = raw * 10^exponent
  integer = 2,         // value = raw
  text = 4,            // the limits bound the number of characters
};

inline constexpr std::size_t kParamNameMax = 23;
inline constexpr std::size_t kParamUnitMax = 7;
inline constexpr std::size_t kParamDocMax = 119;

struct ParamRow {
  Param id;
  std::string_view name;
  std::string_view unit;
  ParamKind kind;
  std::int8_t exponent;
  std::int32_t default_raw;
  std::int32_t minimum_raw;
  std::int32_t maximum_raw;
  std::string_view default_text;  // text rows only
  std::string_view doc;
};

/// Default and limits as real numbers in the row's unit.
struct ParamRange {
  double standard;
  double minimum;
  double maximum;
};

namespace row_detail {

void this_number_does_not_fit_its_scale();  // never defined: naming it stops a constant evaluation

consteval std::int32_t raw(double value, double steps_per_unit) {
  const double scaled = value * steps_per_unit;
  const double nearest = scaled < 0 ? scaled - 0.5 : scaled + 0.5;  // the conversion rounds towards zero
  constexpr double kEnd = 2147483648.0;
  if (!(nearest < kEnd) || !(nearest > -kEnd - 1)) this_number_does_not_fit_its_scale();
  return static_cast<std::int32_t>(nearest);
}

consteval double power(double base, int exponent) {
  double result = 1;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

consteval ParamRow numeric(Param id, std::string_view name, std::string_view unit, ParamKind kind,
                           int exponent, double steps_per_unit, ParamRange range, std::string_view doc) {
  return {.id = id,
          .name = name,
          .unit = unit,
          .kind = kind,
          .exponent = static_cast<std::int8_t>(exponent),
          .default_raw = raw(range.standard, steps_per_unit),
          .minimum_raw = raw(range.minimum, steps_per_unit),
          .maximum_raw = raw(range.maximum, steps_per_unit),
          .default_text = {},
          .doc = doc};
}

}  // namespace row_detail

/// Steps of 2^-fraction_bits.
consteval ParamRow binary_row(Param id, std::string_view name, std::string_view unit, int fraction_bits,
                              ParamRange range, std::string_view doc) {
  return row_detail::numeric(id, name, unit, ParamKind::binary_scaled, -fraction_bits,
                             row_detail::power(2, fraction_bits), range, doc);
}

/// Steps of 10^-digits.
consteval ParamRow decimal_row(Param id, std::string_view name, std::string_view unit, int digits,
                               ParamRange range, std::string_view doc) {
  return row_detail::numeric(id, name, unit, ParamKind::decimal_scaled, -digits,
                             row_detail::power(10, digits), range, doc);
}

consteval ParamRow integer_row(Param id, std::string_view name, std::string_view unit, ParamRange range,
                               std::string_view doc) {
  return row_detail::numeric(id, name, unit, ParamKind::integer, 0, 1, range, doc);
}

/// The limits bound the number of characters.
consteval ParamRow text_row(Param id, std::string_view name, std::string_view standard, std::int32_t shortest,
                            std::int32_t longest, std::string_view doc) {
  return {.id = id,
          .name = name,
          .unit = "",
          .kind = ParamKind::text,
          .exponent = 0,
          .default_raw = 0,
          .minimum_raw = shortest,
          .maximum_raw = longest,
          .default_text = standard,
          .doc = doc};
}

}  // namespace astro
