#include "host/experiment/import/wheel_file.hpp"

#include <algorithm>
#include <utility>

#include "common/fixed/wrapping.hpp"
#include "host/base/byte_source.hpp"
#include "host/experiment/import/text_file.hpp"
#include "host/recording/bag/bag.hpp"
#include "host/recording/bag/bag_files.hpp"
#include "host/recording/files/run_file.hpp"
#include "host/recording/run/sample_messages.hpp"
#include "host/ros2/recorded/ros_messages.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

/// Our counters wrap at 2^32.
recording::WheelTrack track_of(const recording::Run& run) {
  recording::WheelTrack track;
  track.samples.reserve(run.odometry.size());
  std::int64_t left = 0, right = 0;
  const recording::OdometrySample* before = nullptr;
  for (const recording::OdometrySample& sample : run.odometry) {
    if (before != nullptr) {
      left += wrapping_difference(sample.left_counts, before->left_counts);
      right += wrapping_difference(sample.right_counts, before->right_counts);
    }
    before = &sample;
    track.samples.push_back({1000 * sample.time_us, static_cast<double>(left), static_cast<double>(right)});
  }
  if (!run.warning.empty()) track.remarks.push_back({run.warning});
  return track;
}

ImportedWheels read(const fs::path& path, const WheelSelection& selection) {
  if (!recording::is_bag(path)) {
    return {read_wheel_table(path, selection.table), {}};
  }
  if (selection.joints.topic.empty() && is_own_recording(path)) {
    const recording::Run run = recording::read_run(path);
    return {track_of(run), run.info};
  }
  return {recording::wheels_in_bag(path, selection.joints), {}};
}

}  // namespace

bool is_own_recording(const fs::path& path) {
  if (recording::bag_file_kind(path) != recording::BagFileKind::mcap) return false;
  const std::vector<recording::BagTopic> topics = recording::read_bag(path).topics;
  return std::any_of(topics.begin(), topics.end(), [](const recording::BagTopic& topic) {
    return topic.type == recording::wheel_counts_type().name;
  });
}

recording::WheelTrack read_wheel_table(const fs::path& path, const recording::WheelTable& table) {
  if (!is_packed_text(path)) {
    FileSource file(path);
    return recording::wheels_in_table(file, path.string(), table);
  }
  const Bytes text = text_of_file(path);
  MemorySource source(text);
  return recording::wheels_in_table(source, path.string(), table);
}

ImportedWheels read_wheels(const fs::path& path, const WheelSelection& selection) {
  ImportedWheels wheels = read(path, selection);
  if (selection.exchanged)
    for (recording::WheelSample& sample : wheels.track.samples) std::swap(sample.left, sample.right);
  return wheels;
}

}  // namespace astro::experiment
