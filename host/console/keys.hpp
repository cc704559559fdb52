#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Keys for steering, and what they do to a velocity.
namespace astro::console {

enum class Key { forward, backward, left, right, stop, quit };

/// Finds keys in what a terminal sends: W A S D and the arrow keys (both of their codes), space, Q. Codes may
/// arrive in pieces; all other keys are ignored.
class KeyReader {
 public:
  std::vector<Key> read(std::string_view bytes);

 private:
  std::string escape_;  // the begun code of a key, if its end has not arrived
};

/// A velocity in steps of a fifth of the greatest allowed one; each key changes it by one step.
class SteeringWheel {
 public:
  SteeringWheel(double most_mps, double most_radps) : most_mps_(most_mps), most_radps_(most_radps) {}

  void press(Key key);

  double forward() const {
    return static_cast<double>(forward_) / kSteps;
  }  // of the greatest velocity, [-1, 1]
  double left() const { return static_cast<double>(left_) / kSteps; }
  double v_mps() const { return forward() * most_mps_; }
  double omega_radps() const { return left() * most_radps_; }

 private:
  static constexpr int kSteps = 5;
  double most_mps_, most_radps_;
  int forward_ = 0, left_ = 0;
};

}  // namespace astro::console
