#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "host/truth/source/source.hpp"

namespace astro::simulation {

/// The virtual cameras that watch a robot of this process, simulated or emulated, as a source of ground truth.
class CameraTruth : public truth::Source {
 public:
  /// `robot` has take_truth(), what its cameras saw since the last call.
  template <class Robot>
  explicit CameraTruth(std::shared_ptr<Robot> robot)
      : take_([robot = std::move(robot)] { return robot->take_truth(); }) {}

  std::vector<recording::TruthSample> poll() override { return take_(); }
  std::string name() const override { return "sim"; }
  std::string clock() const override { return "robot"; }

 private:
  std::function<std::vector<recording::TruthSample>()> take_;
};

}  // namespace astro::simulation
