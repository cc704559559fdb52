#pragma once

#include "host/truth/source/source.hpp"

namespace astro::truth {

/// No ground truth.
class NoSource : public Source {
 public:
  std::vector<recording::TruthSample> poll() override { return {}; }
  std::string name() const override { return ""; }
  std::string clock() const override { return ""; }
};

}  // namespace astro::truth
