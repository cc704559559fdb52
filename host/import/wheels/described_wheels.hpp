#pragma once

#include <string_view>

#include "host/import/wheels/joint_names.hpp"

namespace astro::importing {

/// What is wrong with a robot's description. Values: the joint, the link, the text that is no number, or both
/// radii in metres.
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

/// Of the wheels that turn with these joints: the cylinder or sphere of their links (of the collision model, otherwise of what is
/// shown), and where the joints are.
///
/// Errors  astro::Error, which names the joint or the link: the text is no XML, nests deeper than 100 levels or is no description of a
///         robot; it has no such joint; a wheel has no such shape (as one of a mesh) or is not as large as the other one; a
///         number is none.
DescribedWheels described_wheels(std::string_view urdf, const JointPair& joints);

/// Whether it has both joints. False also for what is no description.
bool describes(std::string_view urdf, const JointPair& joints);

}  // namespace astro::importing
