#include "host/import/bags/pose_topics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <tuple>

#include "host/formats/files/bag.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/import/bags/sample_limit.hpp"
#include "host/import/bags/time_order.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostStreams = 10'000;

using TakePose =
    std::function<void(const bag::BagTopic&, const ros2::StampedPose&, std::int64_t log_time_ns)>;

struct PoseReport {
  bag::BagReport bag;
  std::uint64_t unreadable = 0;
};

PoseReport for_each_pose(const fs::path& path, const std::string& topic, const TakePose& take) {
  PoseReport report;
  bag::BagHandlers handlers;
  handlers.wants = [&](const bag::BagTopic& at) {
    return ros2::holds_poses(at.type) && at.encoding == "cdr" && (topic.empty() || at.name == topic);
  };
  handlers.message = [&](const bag::BagTopic& at, const bag::BagMessage& message) {
    const auto poses = ros2::poses_in(at.type, message.data);
    report.unreadable += poses ? 0 : 1;
    if (!poses) return;
    for (const ros2::StampedPose& pose : *poses) take(at, pose, message.log_time_ns);
  };
  report.bag = bag::read_bag(path, handlers);
  return report;
}

/// How far the recorder's clock is ahead of the stamps.
struct ClockOffset {
  double least_s = 0, most_s = 0;
  bool any = false;

  void take(std::int64_t log_time_ns, std::int64_t stamp_ns) {
    const double offset_s = (static_cast<double>(log_time_ns) - static_cast<double>(stamp_ns)) * 1e-9;
    least_s = any ? std::min(least_s, offset_s) : offset_s;
    most_s = any ? std::max(most_s, offset_s) : offset_s;
    any = true;
  }
  /// `one_clock`: no step of it was taken back.
  void remark(bool one_clock, std::vector<Remark>& remarks) const {
    constexpr double kOtherClock_s = 3600, kMostSpread_s = 1;
    if (std::abs(least_s) > kOtherClock_s || std::abs(most_s) > kOtherClock_s) {
      const std::string off = std::to_string(std::llround(std::abs(least_s)));
      remarks.push_back({"the stamps of the poses are on another clock than the recorder's: they are " + off +
                             (least_s < 0 ? " s after it" : " s before it"),
                         least_s < 0 ? StampProblem::after_recorder : StampProblem::before_recorder,
                         {off}});
    }
    if (one_clock && most_s - least_s > kMostSpread_s) {
      const std::string spread = std::to_string(std::llround(most_s - least_s));
      remarks.push_back({"the poses reached the recorder with delays that differ by " + spread + " s",
                         StampProblem::delays_differ,
                         {spread}});
    }
  }
};

std::vector<std::string> names_of(std::span<const PoseStream* const> streams) {
  std::vector<std::string> names;
  for (const PoseStream* stream : streams) names.push_back(stream->name());
  return names;
}

std::string with_type(const PoseStream& stream) { return stream.name() + " (" + stream.type + ")"; }

/// The only stream for which `is_meant` is true; nullptr if there is none or more than one.
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

[[noreturn]] void refuse(const fs::path& path, std::span<const PoseStream> all,
                         std::span<const PoseStream* const> left) {
  if (left.empty()) {
    std::vector<std::string> names;
    for (const PoseStream& stream : all) names.push_back(stream.name());
    throw UnclearChoice(
        path.string() + (all.empty() ? " has no poses" : " has no such poses; it has " + listed(names)),
        names, WheelProblem::poses_unclear);
  }
  const bool any = std::ranges::any_of(left, [](const PoseStream* stream) { return !is_estimate(*stream); });
  const std::vector<std::string> names = names_of(left);
  throw UnclearChoice(
      path.string() +
          (any ? " has several streams of poses: "
               : " has no poses of a tracker that can be told from a robot's own odometry; it has ") +
          listed(names),
      names, WheelProblem::poses_unclear);
}

}  // namespace

std::string PoseStream::name() const {
  std::string text = topic;
  if (!child_frame.empty()) text += " " + frame + " " + child_frame;
  return text;
}

std::vector<PoseStream> pose_streams(const fs::path& path) {
  std::map<std::tuple<std::string, std::string, std::string, std::string>, std::size_t> places;
  std::vector<PoseStream> streams;
  const auto take = [&](const bag::BagTopic& topic, const ros2::StampedPose& pose, std::int64_t log_time_ns) {
    // Poses without a child frame form one stream per topic, even if the name of their frame changes.
    const std::string frame = pose.child_frame.empty() ? "" : pose.frame;
    const auto [at, is_new] =
        places.try_emplace({topic.name, topic.type, frame, pose.child_frame}, streams.size());
    if (is_new && streams.size() >= kMostStreams) {
      places.erase(at);
      return;
    }
    if (is_new)
      streams.push_back({topic.name, topic.type, frame, pose.child_frame, 0, {}, log_time_ns, log_time_ns});
    PoseStream& stream = streams[at->second];
    ++stream.poses;
    stream.stamps.take(pose.time_ns);
    stream.first_ns = std::min(stream.first_ns, log_time_ns);
    stream.last_ns = std::max(stream.last_ns, log_time_ns);
  };
  for_each_pose(path, "", take);
  return streams;
}

bool is_estimate(const PoseStream& stream) { return ros2::may_be_estimate(stream.topic, stream.type); }

const PoseStream* recognised_stream(std::span<const PoseStream> streams) {
  std::vector<const PoseStream*> all;
  for (const PoseStream& stream : streams) all.push_back(&stream);
  return recognised(all, false);
}

const PoseStream& chosen_stream(const fs::path& path, std::span<const PoseStream> streams,
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
  if (left.size() > 1)
    remarks.push_back({"the poses are those of " + with_type(*found),
                       ChoiceRemark::poses_recognised,
                       {found->name(), found->type}});
  if (is_estimate(*found))
    remarks.push_back(
        {with_type(*found) +
             " may be an estimate of the robot itself; it counts as ground truth because it was named",
         ChoiceRemark::poses_may_be_estimate,
         {found->name(), found->type}});
  return *found;
}

PoseTopic poses_in_bag(const fs::path& path, const PoseSelection& selection) {
  PoseTopic out;
  out.stream = chosen_stream(path, pose_streams(path), selection, out.remarks);
  const PoseStream& stream = out.stream;
  const bool stamped = stream.stamps.most_are_set();
  ClockOffset offset;
  std::vector<std::int64_t> arrivals_ns;
  // A pose takes 152 bytes of memory when it is placed on the floor, four times as many as these.
  require_possible(stream.poses, 38, "poses", path);
  out.poses.reserve(stream.poses);
  const auto take = [&](const bag::BagTopic& topic, const ros2::StampedPose& pose, std::int64_t log_time_ns) {
    if (topic.type != stream.type || pose.child_frame != stream.child_frame ||
        (!pose.child_frame.empty() && pose.frame != stream.frame))
      return;
    if (stamped && stream.stamps.is_missing(pose.time_ns)) return;
    if (stamped) {
      offset.take(log_time_ns, pose.time_ns);
      arrivals_ns.push_back(log_time_ns);
    }
    out.poses.push_back({stamped ? pose.time_ns : log_time_ns, pose.x_m, pose.y_m, pose.z_m, pose.qx, pose.qy,
                         pose.qz, pose.qw});
  };
  const PoseReport report = for_each_pose(path, stream.topic, take);
  out.remarks.insert(out.remarks.end(), report.bag.warnings.begin(), report.bag.warnings.end());
  if (report.unreadable > 0)
    out.remarks.push_back(
        {std::to_string(report.unreadable) + " messages do not fit their type and were left out"});
  const std::string what = "poses of " + stream.topic;
  if (stamped) stream.stamps.remark(what, out.remarks);
  const bool stepped = order_by_time(out.poses, arrivals_ns, path.string(), what, out.remarks);
  offset.remark(!stepped, out.remarks);
  return out;
}

}  // namespace astro::importing
