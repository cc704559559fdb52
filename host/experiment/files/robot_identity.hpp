#pragma once

#include <string>

#include "common/protocol/session.hpp"
#include "host/recording/run.hpp"

/// The identity of a robot, for recordings and calibrations.
namespace astro::experiment {

struct RobotIdentity {
  std::string name;  // that its owner gave it; "" if unknown
  std::string id;    // of its processor, 32 hexadecimal digits; "" if unknown
  bool operator==(const RobotIdentity&) const = default;
};

RobotIdentity identity_of(const protocol::HelloReply& robot);
RobotIdentity identity_of(const recording::RunInfo& info);

/// The sentence that `a` and `b` are of different robots, "" if they are of the same one or that is unknown: "the
/// calibration is of robot ASTRO (17...), and this is ARES (18...)" for `what` "the calibration" and `other`
/// "this". A name alone decides nothing: it may have been changed, or be the default of every robot.
std::string different_robots(const std::string& what, const RobotIdentity& a, const std::string& other,
                             const RobotIdentity& b);

}  // namespace astro::experiment
