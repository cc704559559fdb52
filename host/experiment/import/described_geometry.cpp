#include "host/experiment/import/described_geometry.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "host/base/error.hpp"
#include "host/recording/bag/bag.hpp"
#include "host/recording/foreign/described_wheels.hpp"
#include "host/ros2/recorded/text_message.hpp"

namespace astro::experiment {
namespace {

constexpr std::size_t kLongest = 4 << 20;  // of a description; those with meshes only name the files

struct Described {
  std::string topic, urdf;
};

/// Of all descriptions with these joints the last one: sizes may have been corrected while the robot drove.
std::optional<Described> description_in(const std::filesystem::path& bag,
                                        const recording::JointPair& joints) {
  std::optional<Described> found;
  recording::BagHandlers handlers;
  handlers.wants = [](const recording::BagTopic& topic) {
    return topic.type == ros2::string_type().name && topic.encoding == "cdr" &&
           (topic.name == "robot_description" || topic.name.ends_with("/robot_description"));
  };
  handlers.message = [&](const recording::BagTopic& topic, const recording::BagMessage& message) {
    if (message.data.size() > kLongest) return;
    auto urdf = ros2::decode_text(message.data);
    if (urdf && recording::describes(*urdf, joints)) found = Described{topic.name, std::move(*urdf)};
  };
  recording::read_bag(bag, handlers);
  return found;
}

}  // namespace

RobotGeometry completed_by_description(RobotGeometry given, const std::filesystem::path& bag,
                                       const recording::WheelTrack& wheels, std::vector<Remark>& remarks) {
  if ((given.wheel_diameter_m && given.wheelbase_m) || wheels.joints.left.empty()) return given;
  const std::optional<Described> found = description_in(bag, wheels.joints);
  if (!found) return given;
  recording::DescribedWheels sizes;
  try {
    sizes = recording::described_wheels(found->urdf, wheels.joints);
  } catch (const Error& error) {
    throw Error(fmt::format("{}, {}: {}", bag.string(), found->topic, error.what()),
                {Help::give_wheel_diameter});
  }
  if (!given.wheel_diameter_m) given.wheel_diameter_m = 2 * sizes.radius_m;
  if (!given.wheelbase_m) given.wheelbase_m = sizes.separation_m;
  remarks.push_back({fmt::format("{} has wheels of {:.6g} m, {:.6g} m apart", found->topic,
                                 2 * sizes.radius_m, sizes.separation_m)});
  return given;
}

}  // namespace astro::experiment
