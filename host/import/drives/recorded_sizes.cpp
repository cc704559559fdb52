#include "host/import/drives/recorded_sizes.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/messages/text_message.hpp"
#include "host/import/wheels/described_wheels.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestDescription = 4 << 20;  // bytes; meshes are in files of their own

struct Described {
  std::string topic, urdf;
};

/// Finds the last description with these joints: sizes may have been corrected while the robot drove.
std::optional<Described> description_in(const fs::path& bag, const JointPair& joints) {
  std::optional<Described> found;
  bag::BagHandlers handlers;
  handlers.wants = [](const bag::BagTopic& topic) {
    return topic.type == ros2::string_type().name && topic.encoding == "cdr" &&
           (topic.name == "robot_description" || topic.name.ends_with("/robot_description"));
  };
  handlers.message = [&](const bag::BagTopic& topic, const bag::BagMessage& message) {
    if (message.data.size() > kLongestDescription) return;
    auto urdf = ros2::decode_text(message.data);
    if (urdf && describes(*urdf, joints)) found = Described{topic.name, std::move(*urdf)};
  };
  bag::read_bag(bag, handlers);
  return found;
}

RobotGeometry completed_by_description(RobotGeometry given, const fs::path& bag, const WheelTrack& wheels,
                                       std::vector<Remark>& remarks) {
  if ((given.wheel_diameter_m && given.wheelbase_m) || wheels.joints.left.empty()) return given;
  const std::optional<Described> found = description_in(bag, wheels.joints);
  if (!found) return given;
  DescribedWheels sizes;
  try {
    sizes = described_wheels(found->urdf, wheels.joints);
  } catch (const Error& error) {
    throw Error(fmt::format("{}, {}: {}", bag.string(), found->topic, error.what()),
                ImportProblem::sizes_not_described);
  }
  if (!given.wheel_diameter_m) given.wheel_diameter_m = 2 * sizes.radius_m;
  if (!given.wheelbase_m) given.wheelbase_m = sizes.separation_m;
  remarks.push_back({fmt::format("{} has wheels of {:.6g} m, {:.6g} m apart", found->topic,
                                 2 * sizes.radius_m, sizes.separation_m)});
  return given;
}

}  // namespace

const RobotGeometry& RecordedSizes::of(const fs::path& file, ImportedWheels& wheels) {
  RobotGeometry described = completed_by_description(given_, file, wheels.track, wheels.track.remarks);
  if (described.wheel_diameter_m != given_.wheel_diameter_m || described.wheelbase_m != given_.wheelbase_m)
    last_ = std::move(described);
  return last_;
}

}  // namespace astro::importing
