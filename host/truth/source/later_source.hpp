#pragma once

#include <string>
#include <utility>

#include "host/truth/source/source.hpp"

namespace astro::truth {

/// Ground truth that comes for many runs at once, after all of them: a film. Until then the recordings have none, and their
/// `truth_source` says what they wait for.
class LaterSource : public Source {
 public:
  explicit LaterSource(std::string name) : name_(std::move(name)) {}

  std::vector<recording::TruthSample> poll() override { return {}; }
  std::string name() const override { return name_; }
  std::string clock() const override { return name_; }

 private:
  std::string name_;
};

}  // namespace astro::truth
