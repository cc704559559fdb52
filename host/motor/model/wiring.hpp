#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/motor/model/motor_model.hpp"

/// Finds wiring faults of a robot from driving one motor after the other.
///
/// Counts alone say little: a reversed motor and a reversed encoder look alike, so do swapped motors and
/// swapped encoders, and two faults can cancel (a robot whose motors and encoders are both swapped turns left
/// for right and counts as it should). A person who looks at the wheels can tell. With that observation, each
/// motor and each encoder is located and oriented on its own, for any combination of faults.
namespace astro::motor {

/// The counts of one encoder while a motor was driven; forward positive by the robot's parameters.
struct EncoderTrace {
  long counts = 0;   // from the first sample to the last
  long range = 0;    // most minus least
  long changes = 0;  // samples that differ from the one before
};

enum class Motion { none, forward, backward, toggles };

/// How the encoder moved. `toggles`: up and down by one, as if one of its two channels were missing.
Motion motion_of(const EncoderTrace& trace);

/// What a person saw; `wheel` is nullopt if none turned.
struct Sighting {
  std::optional<Side> wheel;
  bool forward = true;
};

/// The result of driving one motor forward by the robot's parameters.
struct Probe {
  std::array<EncoderTrace, 2> encoders;  // left, right
  double voltage_V = 0;                  // the most that was put on it
  std::optional<Sighting> seen;          // nullopt: nobody looked
};

/// The robot's parameters, each +1 or -1: left, right.
struct Polarities {
  std::array<int, 2> motor{1, 1}, encoder{1, 1};
};

/// One thing that is wrong. `fault`: a word for scripts.
struct Finding {
  std::string fault;
  Remark remark;
};

struct WiringVerdict {
  std::vector<Finding> findings;             // empty: nothing is wrong
  std::map<std::string, double> parameters;  // those to change, by name; they hold once wires are right
  bool needs_hands = false;                  // wires have to be changed; parameters alone are not enough
  bool needs_eyes = false;                   // a person has to say which wheel turned
};

/// `probes`: of the left and of the right motor, as the robot names them.
WiringVerdict judge_wiring(const std::array<Probe, 2>& probes, const Polarities& polarities);

}  // namespace astro::motor
