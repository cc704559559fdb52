#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/formats/tables/units.hpp"

/// Names of columns, taken apart.
namespace astro::tables {

/// "encoderLeft [ticks]", "left_encoder_ticks" and "left.encoder.ticks" have the words left and encoder and the unit ticks.
struct ColumnName {
  std::vector<std::string> words;  // in lower case, in the order of the name, without the unit
  std::optional<Unit> unit;
  std::string
      unit_text;  // as in the name, in lower case; also one that is not known, if it stands in brackets

  bool has(std::initializer_list<std::string_view> any) const;
};

/// Takes a name in any style apart: words end at marks, at blanks, and where a capital letter begins one. The unit is in
/// brackets, or the last words.
ColumnName column_name(std::string_view text);

}  // namespace astro::tables
