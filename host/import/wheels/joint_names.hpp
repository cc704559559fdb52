#pragma once

#include <optional>
#include <span>
#include <string>

namespace astro::importing {

struct JointPair {
  std::string left, right;

  bool operator==(const JointPair&) const = default;
};

/// Finds the joints of the driven wheels: the one pair whose names differ only in the word for the side (left
/// and right, l and r, port and starboard). If there are several pairs, it is the one whose names contain a
/// word such as wheel, tyre, tire, drive or motor. Nothing if no pair or more than one remains.
std::optional<JointPair> recognise_wheels(std::span<const std::string> names);

}  // namespace astro::importing
