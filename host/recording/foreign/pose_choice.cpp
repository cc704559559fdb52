#include "host/recording/foreign/pose_choice.hpp"

#include <algorithm>
#include <string>

#include "host/recording/foreign/unclear_choice.hpp"
#include "host/ros2/recorded/estimates.hpp"

namespace astro::recording {
namespace {

std::vector<std::string> names_of(std::span<const PoseStream* const> streams) {
  std::vector<std::string> names;
  for (const PoseStream* stream : streams) names.push_back(stream->name());
  return names;
}

std::string with_type(const PoseStream& stream) { return stream.name() + " (" + stream.type + ")"; }

/// The only one of them that `is_meant`, or nullptr.
const PoseStream* only(std::span<const PoseStream* const> streams, const auto& is_meant) {
  const PoseStream* found = nullptr;
  for (const PoseStream* stream : streams) {
    if (!is_meant(*stream)) continue;
    if (found != nullptr) return nullptr;
    found = stream;
  }
  return found;
}

const PoseStream* recognised(std::span<const PoseStream* const> streams, bool named) {
  const auto no_estimate = [](const PoseStream& stream) { return !is_estimate(stream); };
  if (named && streams.size() == 1) return streams.front();
  if (const PoseStream* one =
          only(streams, [&](const auto& at) { return ros2::speaks_of_tracker(at.topic) && no_estimate(at); }))
    return one;
  return only(streams, no_estimate);
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::span<const PoseStream> all,
                         std::span<const PoseStream* const> left) {
  if (left.empty()) {
    std::vector<std::string> names;
    for (const PoseStream& stream : all) names.push_back(stream.name());
    throw UnclearChoice(
        path.string() + (all.empty() ? " has no poses" : " has no such poses; it has " + listed(names)),
        names, Help::name_pose_stream);
  }
  const bool any = std::ranges::any_of(left, [](const PoseStream* stream) { return !is_estimate(*stream); });
  const std::vector<std::string> names = names_of(left);
  throw UnclearChoice(
      path.string() +
          (any ? " has several streams of poses: "
               : " has no poses of a tracker that can be told from a robot's own odometry; it has ") +
          listed(names),
      names, Help::name_pose_stream);
}

}  // namespace

bool is_estimate(const PoseStream& stream) { return ros2::may_be_estimate(stream.topic, stream.type); }

const PoseStream& chosen_stream(const std::filesystem::path& path, std::span<const PoseStream> streams,
                                const PoseSelection& selection, std::vector<Remark>& remarks) {
  std::vector<const PoseStream*> left;
  for (const PoseStream& stream : streams)
    if ((selection.topic.empty() || stream.topic == selection.topic) &&
        (selection.frame.empty() || stream.frame == selection.frame) &&
        (selection.child_frame.empty() || stream.child_frame == selection.child_frame))
      left.push_back(&stream);
  const bool named = !selection.topic.empty() || !selection.frame.empty() || !selection.child_frame.empty();
  const PoseStream* found = recognised(left, named);
  if (found == nullptr) refuse(path, streams, left);
  if (left.size() > 1) remarks.push_back({"the poses are those of " + with_type(*found)});
  if (is_estimate(*found))
    remarks.push_back(
        {with_type(*found) +
         " may be an estimate of the robot itself; it counts as ground truth because it was named"});
  return *found;
}

}  // namespace astro::recording
