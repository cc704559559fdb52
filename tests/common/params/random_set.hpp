#pragma once

#include <algorithm>
#include <random>
#include <string>

#include "common/params/parameter_set.hpp"

namespace astro::support {

inline ParamText random_name(std::mt19937& random) {
  std::string name(1 + random() % ParamText::kCapacity, ' ');
  for (char& c : name) c = static_cast<char>(' ' + random() % 95);
  return ParamText(name);
}

/// A set that validate() accepts: every row somewhere within its limits, the rules between rows kept by
/// drawing again.
inline ParameterSet random_valid_set(std::mt19937& random) {
  for (;;) {
    ParameterSet set;
    for (const ParamRow& row : kParamTable) {
      if (row.kind == ParamKind::text) {
        set.set_text(row.id, random_name(random));
      } else if (row.minimum_raw == -1) {
        set.set(row.id, random() % 2 == 0 ? 1 : -1);
      } else {
        set.set(row.id, std::uniform_int_distribution(row.minimum_raw, row.maximum_raw)(random));
      }
    }
    if (validate(set)) return set;
  }
}

}  // namespace astro::support
