#pragma once

#include <stdexcept>
#include <string>

namespace astro {

/// What the host tools throw when something outside the program is wrong: one clear sentence that names the
/// thing and the remedy. The CLI prints it as it stands and exits with 1.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& sentence) : std::runtime_error(sentence) {}
};

}  // namespace astro
