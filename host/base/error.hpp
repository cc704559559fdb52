#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "host/base/remedy.hpp"

namespace astro {

/// What the host tools throw when something outside the program is wrong: what() is one clear sentence that
/// states what happened and names the thing; remedy() says what would help where that depends on the commands.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& fact, Remedy remedy = {})
      : std::runtime_error(fact), remedy_(std::move(remedy)) {}
  explicit Error(const Remark& remark) : Error(remark.fact, remark.remedy) {}

  const Remedy& remedy() const { return remedy_; }

 private:
  Remedy remedy_;
};

}  // namespace astro
