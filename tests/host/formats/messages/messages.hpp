#pragma once

#include <tuple>

#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/nodes.hpp"
#include "host/formats/messages/parameters.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/formats/messages/std.hpp"

namespace astro::ros2 {

/// All message types, for claims that hold for each of them.
using AllMessages =
    std::tuple<msg::Time, msg::Header, msg::Clock, msg::String, msg::Vector3, msg::Point, msg::Quaternion,
               msg::Pose, msg::PoseStamped, msg::PoseWithCovariance, msg::PoseWithCovarianceStamped,
               msg::Twist, msg::TwistStamped, msg::TwistWithCovariance, msg::Transform, msg::TransformStamped,
               msg::TFMessage, msg::Odometry, msg::JointState, msg::BatteryState, msg::KeyValue,
               msg::DiagnosticStatus, msg::DiagnosticArray, msg::ParameterValue, msg::Parameter,
               msg::ParameterDescriptor, msg::FloatingPointRange, msg::IntegerRange, msg::SetParametersResult,
               msg::ListParametersResult, msg::ParameterEvent, msg::Log, msg::ParticipantEntitiesInfo<16>,
               msg::Trigger::Request, msg::Trigger::Response, msg::SetBool::Request, msg::SetBool::Response,
               msg::GetParameters::Request, msg::GetParameters::Response, msg::GetParameterTypes::Request,
               msg::GetParameterTypes::Response, msg::SetParameters::Request, msg::SetParameters::Response,
               msg::SetParametersAtomically::Request, msg::SetParametersAtomically::Response,
               msg::ListParameters::Request, msg::ListParameters::Response, msg::DescribeParameters::Request,
               msg::DescribeParameters::Response>;

template <class Visit>
void for_each_message(Visit&& visit) {
  std::apply([&](const auto&... message) { (visit(message), ...); }, AllMessages{});
}

}  // namespace astro::ros2
