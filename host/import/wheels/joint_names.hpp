#pragma once

#include <optional>
#include <span>
#include <string>

namespace astro::importing {

struct JointPair {
  std::string left, right;

  bool operator==(const JointPair&) const = default;
};

/// Which of these joints are the driven wheels: the one pair whose names differ only in the word for the side (left and
/// right, l and r, port and starboard) and, if there are several, the one that speaks of wheels, tyres, tires, drives or
/// motors. Nothing if no pair or more than one is left.
std::optional<JointPair> recognise_wheels(std::span<const std::string> names);

}  // namespace astro::importing
