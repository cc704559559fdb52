#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"

namespace astro::recording {

struct JointPair {
  std::string left, right;

  bool operator==(const JointPair&) const = default;
};

/// Which of these joints are the driven wheels: the one pair whose names differ only in the word for the side (left and
/// right, l and r, port and starboard) and, if there are several, the one that speaks of wheels, tyres, tires, drives or
/// motors. Nothing if no pair or more than one is left.
std::optional<JointPair> recognise_wheels(std::span<const std::string> names);

/// The wheels cannot be told from the names alone; choices() is what there is to choose from.
class UnclearChoice : public Error {
 public:
  UnclearChoice(const std::string& fact, std::vector<std::string> choices)
      : Error(fact), choices_(std::move(choices)) {}
  const std::vector<std::string>& choices() const { return choices_; }

 private:
  std::vector<std::string> choices_;
};

}  // namespace astro::recording
