#pragma once

#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"

namespace astro::importing {

/// What a file alone does not tell.
enum class WheelProblem {
  columns_unclear,
  joints_unclear,
  topic_unclear,
  poses_unclear,
  controller_unclear,
  nothing_to_choose
};

/// What was meant cannot be told from a file alone, or is not in it; choices() is what there is to choose from.
class UnclearChoice : public Error {
 public:
  UnclearChoice(const std::string& sentence, std::vector<std::string> choices, WheelProblem unclear)
      : Error(choices.empty() ? sentence + ": name the right file" : sentence,
              choices.empty() ? WheelProblem::nothing_to_choose : unclear),
        choices_(std::move(choices)) {}
  const std::vector<std::string>& choices() const { return choices_; }

 private:
  std::vector<std::string> choices_;
};

/// The choices between commas.
inline std::string listed(const std::vector<std::string>& choices) {
  std::string text;
  for (const std::string& choice : choices) text += (text.empty() ? "" : ", ") + choice;
  return text.empty() ? "none" : text;
}

}  // namespace astro::importing
