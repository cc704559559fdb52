#include "host/import/drives/file_inspection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "host/base/bytes.hpp"
#include "host/formats/files/bag_files.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/import/drives/bag_truth.hpp"
#include "host/import/drives/wheel_file.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/sample_messages.hpp"
#include "host/truth/files/tracker_file.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostJoints = 1000;

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

double rate_hz(std::uint64_t samples, double duration_s) {
  return duration_s > 0 ? static_cast<double>(samples - 1) / duration_s : 0;
}

/// Collects in one pass over a bag what it shows of each topic.
class Pass {
 public:
  BagInspection over(const fs::path& path) {
    bag::BagHandlers handlers;
    handlers.message = [this](const bag::BagTopic& topic, const bag::BagMessage& message) {
      take(topic, message);
    };
    BagInspection out;
    out.report = bag::read_bag(path, handlers);
    for (const bag::BagTopic& topic : out.report.topics)
      out.topics.push_back({topic, rate_hz(topic.messages, seconds(topic.last_ns - topic.first_ns)),
                            gaps_[topic.name].longest_s});
    out.joints.assign(joints_.begin(), joints_.end());
    out.wheels = recognise_wheels(out.joints);
    return out;
  }

 private:
  struct Gap {
    std::int64_t last_ns = 0;
    bool any = false;
    double longest_s = 0;
  };

  void take(const bag::BagTopic& topic, const bag::BagMessage& message) {
    Gap& gap = gaps_[topic.name];
    if (gap.any)
      gap.longest_s = std::max(gap.longest_s, std::abs(seconds(message.log_time_ns - gap.last_ns)));
    gap = {message.log_time_ns, true, gap.longest_s};
    if (topic.type != ros2::joint_state_type().name || joints_.size() >= kMostJoints) return;
    if (const auto state = ros2::decode_joint_state(message.data))
      for (const std::string& name : state->names)
        if (joints_.size() < kMostJoints) joints_.insert(name);
  }

  std::map<std::string, Gap, std::less<>> gaps_;
  std::set<std::string> joints_;
};

/// As wheels_in_bag chooses.
std::optional<WheelSource> source_taken(const BagInspection& bag) {
  const auto joints = std::ranges::count(bag.sources, WheelSource::Kind::joints, &WheelSource::kind);
  if (joints > 1) return std::nullopt;
  if (joints == 1 && bag.wheels) return bag.sources.front();
  const WheelSource* found = recognised_source(bag.sources);
  return found == nullptr ? std::nullopt : std::optional(*found);
}

BagInspection inspect_bag(const fs::path& path) {
  BagInspection bag = Pass().over(path);
  bag.poses = pose_streams(path);
  if (const PoseStream* truth = recognised_stream(bag.poses)) bag.truth = *truth;
  bag.sources = wheel_sources(bag.report.topics);
  bag.source = source_taken(bag);
  bag.ros1 = bag::is_ros1_bag(path);
  const bool own = std::any_of(bag.topics.begin(), bag.topics.end(), [](const TopicInspection& one) {
    return one.topic.type == recording::wheel_counts_type().name;
  });
  if (own && bag::bag_file_kind(path) == bag::BagFileKind::mcap) bag.run = recording::read_run_info(path);
  return bag;
}

bool ends_as_it_begins(const std::vector<WheelSample>& samples, double WheelSample::*wheel) {
  constexpr double kSame = 0.02;  // of the range
  const auto [least, most] = std::ranges::minmax(samples, {}, wheel);
  return most.*wheel > least.*wheel &&
         std::abs(samples.back().*wheel - samples.front().*wheel) <= kSame * (most.*wheel - least.*wheel);
}

/// Whether the file holds settings. Only its extension shows this; tables never have one of these extensions.
bool is_settings(const fs::path& path) {
  const fs::path end = path.extension();
  return end == ".toml" || end == ".yaml" || end == ".yml";
}

/// Nothing if the file is not a recording of a tracker. Its text is released before the caller reads it as
/// another kind.
std::optional<truth::Inspection> inspect_tracker(const fs::path& path, const std::string& columns) {
  const Bytes bytes = tables::text_of_file(path);
  const std::string_view text = as_text(bytes);
  if (columns.empty() && truth::recognise(text) == truth::FileKind::unknown) return std::nullopt;
  return truth::inspect(text, path.string(), columns);
}

/// Nothing if no columns are named as the errors of ends. What else is wrong with a table that has them is thrown.
std::optional<calibration::EndPoseTable> inspect_end_poses(const fs::path& path) {
  const Bytes bytes = tables::text_of_file(path);
  try {
    return calibration::read_end_poses(as_text(bytes), path.string());
  } catch (const Error& error) {
    if (error.kind() != calibration::EndPoseTableProblem::no_column) throw;
    return std::nullopt;
  }
}

/// Nothing if the columns do not show which of them are the wheels.
std::optional<WheelInspection> inspect_wheels_beside_poses(const fs::path& path, const WheelTable& table) {
  try {
    return inspect_wheels(read_wheel_table(path, table));
  } catch (const UnclearChoice&) {
    return std::nullopt;
  }
}

FileInspection inspect_text(const fs::path& path, const WheelTable& table, const std::string& truth_columns) {
  FileInspection out;
  if (table.columns.empty()) out.tracker = inspect_tracker(path, truth_columns);
  if (out.tracker) {
    if (out.tracker->kind == truth::FileKind::plain) out.wheels = inspect_wheels_beside_poses(path, table);
    return out;
  }
  try {
    out.wheels = inspect_wheels(read_wheel_table(path, table));
  } catch (const UnclearChoice&) {
    out.end_poses = inspect_end_poses(path);
    if (!out.end_poses) throw;
  }
  return out;
}

}  // namespace

WheelInspection inspect_wheels(WheelTrack track) {
  WheelInspection out;
  out.track = std::move(track);
  const std::vector<WheelSample>& samples = out.track.samples;
  out.duration_s = seconds(samples.back().time_ns - samples.front().time_ns);
  out.rate_hz = rate_hz(samples.size(), out.duration_s);
  for (std::size_t i = 1; i < samples.size(); ++i)
    out.longest_gap_s = std::max(out.longest_gap_s, seconds(samples[i].time_ns - samples[i - 1].time_ns));
  out.left = samples.back().left - samples.front().left;
  out.right = samples.back().right - samples.front().right;
  out.end_as_they_begin =
      ends_as_it_begins(samples, &WheelSample::left) && ends_as_it_begins(samples, &WheelSample::right);
  return out;
}

FileInspection inspect_file(const fs::path& path, const WheelTable& table, const TruthSelection& truth) {
  const PoseSelection& topic = truth.poses;
  FileInspection out;
  if (bag::is_bag(path) && topic.topic.empty()) {
    out.bag = inspect_bag(path);
  } else if (bag::is_bag(path)) {
    truth::BodyTrack track = track_in_bag(path, topic);
    out.tracker = truth::Inspection{};
    out.tracker->bodies.push_back(truth::inspect(track));
  } else if (is_settings(path)) {
    out.robot = read_robot_file(path);
  } else {
    out = inspect_text(path, table, truth.columns);
  }
  return out;
}

}  // namespace astro::importing
