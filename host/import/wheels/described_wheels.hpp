#pragma once

#include <string_view>

#include "host/import/wheels/joint_names.hpp"

namespace astro::importing {

/// What is wrong with a robot's description. Values: the joint, the link, the text that is not a number, or
/// both radii in metres.
enum class DescriptionProblem {
  not_xml,
  no_robot,
  no_joint,
  joints_in_circle,
  no_round_wheel,
  radii_differ,
  not_a_number
};

/// The wheels of a robot as its description (URDF) has them.
struct DescribedWheels {
  double radius_m = 0;      // of both
  double separation_m = 0;  // from one to the other along their axle
};

/// The sizes of the wheels that turn with these joints, from the cylinder or sphere of their links (of the
/// collision model, otherwise of the visual one) and from the positions of the joints.
///
/// Errors  astro::Error, which names the joint or the link, if the text is not XML, nests deeper than 100
///         levels or is not the description of a robot; if it has no such joint; if a wheel has no such shape
///         (for example a mesh) or another radius than the other wheel; or if a number cannot be read.
DescribedWheels described_wheels(std::string_view urdf, const JointPair& joints);

/// Whether the description has both joints. False also for a text that is not a description.
bool describes(std::string_view urdf, const JointPair& joints);

}  // namespace astro::importing
