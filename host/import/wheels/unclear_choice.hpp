#pragma once

#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"

namespace astro::importing {

/// What was meant cannot be told from a file alone, or is not in it; choices() is what there is to choose from.
class UnclearChoice : public Error {
 public:
  UnclearChoice(const std::string& fact, std::vector<std::string> choices, Help help)
      : Error(fact, {choices.empty() ? Help::name_right_file : help}), choices_(std::move(choices)) {}
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
