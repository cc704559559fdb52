#include "host/import/wheels/described_wheels.hpp"

#include <gmock/gmock.h>

#include "host/formats/messages/robot_model.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::importing {
namespace {

using support::Tells;
using support::told_by;

const JointPair kWheelJoints{"left_wheel_joint", "right_wheel_joint"};

std::string robot_xml(const std::string& inside) {
  return "<?xml version='1.0'?><robot name='r'>" + inside + "</robot>";
}

std::string link_xml(const std::string& name, const std::string& geometry,
                     const std::string& model = "collision") {
  return "<link name='" + name + "'><" + model + "><geometry>" + geometry + "</geometry></" + model +
         "></link>";
}

std::string joint_xml(const std::string& name, const std::string& parent, const std::string& child,
                      const std::string& rest) {
  return "<joint name='" + name + "' type='continuous'><parent link='" + parent + "'/><child link='" + child +
         "'/>" + rest + "</joint>";
}

std::string wheels_xml(const std::string& left_shape, const std::string& right_shape) {
  return robot_xml(
      link_xml("l", left_shape) + link_xml("r", right_shape) +
      joint_xml("left_wheel_joint", "base", "l", "<origin xyz='0 0.15 0'/><axis xyz='0 1 0'/>") +
      joint_xml("right_wheel_joint", "base", "r", "<origin xyz='0 -0.15 0'/><axis xyz='0 1 0'/>"));
}

Remark wheels_refusal(const std::string& urdf, const JointPair& joints = kWheelJoints) {
  return told_by([&] { described_wheels(urdf, joints); });
}

TEST(DescribedWheels, OfThisProjectsOwnDescription) {
  const ros2::RobotModel model({{"wheel_diameter", 0.072},
                                {"b", 0.2886},
                                {"counts_per_motor_rev", 64},
                                {"gear_numerator", 437},
                                {"gear_denominator", 10}});
  const DescribedWheels found = described_wheels(model.urdf("left/", "left/base_footprint"), kWheelJoints);
  EXPECT_NEAR(found.radius_m, 0.036, 1e-12);
  EXPECT_NEAR(found.separation_m, 0.2886, 1e-12);
}

TEST(DescribedWheels, WhereverTheAxleLiesAndHoweverTheJointsAreTurned) {
  // As of TurtleBot 3: the wheels are turned so that their z is the axle; and the base is turned against the first link.
  const std::string urdf =
      robot_xml(link_xml("l", "<mesh filename='tire.stl'/>", "visual") +
                link_xml("wheel_left", "<cylinder length='0.018' radius='0.033'/>") +
                link_xml("wheel_right", "<sphere radius='0.033'/>", "visual") +
                joint_xml("base_joint", "footprint", "base", "<origin xyz='0.3 0 0.01' rpy='0 0 0.7'/>") +
                joint_xml("left_wheel_joint", "base", "wheel_left",
                          "<origin xyz='0.0 0.08 0.023' rpy='-1.57 0 0'/><axis xyz='0 0 1'/>") +
                joint_xml("right_wheel_joint", "base", "wheel_right",
                          "<origin xyz='0.0 -0.08 0.023' rpy='-1.57 0 0'/><axis xyz='0 0 1'/>"));
  const DescribedWheels found = described_wheels(urdf, kWheelJoints);
  EXPECT_EQ(found.radius_m, 0.033);
  EXPECT_NEAR(found.separation_m, 0.16, 1e-6);
  EXPECT_TRUE(describes(urdf, kWheelJoints));
  EXPECT_FALSE(describes(urdf, {"left_wheel_joint", "arm"}));
}

TEST(DescribedWheels, WhatIsMissingOrDiffersIsNamed) {
  const std::string cylinder = "<cylinder radius='0.04' length='0.01'/>";
  EXPECT_NO_THROW(described_wheels(wheels_xml(cylinder, cylinder), kWheelJoints));
  EXPECT_THAT(wheels_refusal(wheels_xml(cylinder, "<mesh filename='x.stl'/>")),
              Tells(DescriptionProblem::no_round_wheel, "r"));
  EXPECT_THAT(wheels_refusal(wheels_xml(cylinder, "<cylinder radius='0.041' length='0.01'/>")),
              Tells(DescriptionProblem::radii_differ, "0.04", "0.041"));
  EXPECT_THAT(wheels_refusal(wheels_xml(cylinder, "<cylinder radius='${r}' length='0.01'/>")),
              Tells(DescriptionProblem::not_a_number, "${r}"));
  EXPECT_THAT(wheels_refusal(wheels_xml(cylinder, "<cylinder radius='nan' length='0.01'/>")),
              Tells(DescriptionProblem::not_a_number, "nan"));
  EXPECT_THAT(wheels_refusal(wheels_xml(cylinder, cylinder), {"left_wheel_joint", "arm"}),
              Tells(DescriptionProblem::no_joint, "arm"));
  EXPECT_THAT(wheels_refusal("<robot>"), Tells(DescriptionProblem::not_xml));
  EXPECT_THAT(wheels_refusal("robot"), Tells(DescriptionProblem::not_xml));
  EXPECT_THAT(wheels_refusal("<sdf/>"), Tells(DescriptionProblem::no_robot));
}

TEST(DescribedWheels, ACircleOfJointsAndADeepNestAreRefused) {
  const std::string cylinder = "<cylinder radius='0.04' length='0.01'/>";
  EXPECT_THAT(wheels_refusal(robot_xml(link_xml("l", cylinder) + link_xml("r", cylinder) +
                                       joint_xml("left_wheel_joint", "r", "l", "") +
                                       joint_xml("right_wheel_joint", "l", "r", ""))),
              Tells(DescriptionProblem::joints_in_circle, "left_wheel_joint"));
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) deep += "<a>";
  EXPECT_THAT(wheels_refusal(deep), Tells(DescriptionProblem::not_xml));
}

}  // namespace
}  // namespace astro::importing
