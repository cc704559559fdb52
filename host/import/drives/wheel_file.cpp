#include "host/import/drives/wheel_file.hpp"

#include <algorithm>
#include <utility>

#include "common/fixed/wrapping.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/files/bag_files.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/sample_messages.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;

/// Makes the counters of a recording of this project continuous; they wrap at 2^32.
WheelTrack track_of(const recording::Run& run) {
  WheelTrack track;
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
  if (run.warning) track.remarks.push_back(*run.warning);
  return track;
}

ImportedWheels read(const fs::path& path, const WheelSelection& selection) {
  if (!bag::is_bag(path)) {
    return {read_wheel_table(path, selection.table), {}};
  }
  if (selection.bag.topic.empty() && is_own_recording(path)) {
    recording::Run run = recording::read_run(path);
    return {track_of(run), run.info, {}, std::move(run.gyro), std::move(run.slips)};
  }
  return {wheels_in_bag(path, selection.bag), {}, imu_rates_in_bag(path, selection.imu_topic)};
}

}  // namespace

bool is_own_recording(const fs::path& path) {
  if (bag::bag_file_kind(path) != bag::BagFileKind::mcap) return false;
  const std::vector<bag::BagTopic> topics = bag::read_bag(path).topics;
  return std::any_of(topics.begin(), topics.end(), [](const bag::BagTopic& topic) {
    return topic.type == recording::wheel_counts_type().name;
  });
}

WheelTrack read_wheel_table(const fs::path& path, const WheelTable& table) {
  const Bytes text = tables::text_of_file(path);
  return wheels_in_table(as_text(text), path.string(), table);
}

void orient(WheelTrack& track, const WheelSelection& selection) {
  if (selection.exchanged)
    for (WheelSample& sample : track.samples) std::swap(sample.left, sample.right);
  if (selection.reversed)
    for (WheelSample& sample : track.samples) sample = {sample.time_ns, -sample.left, -sample.right};
}

ImportedWheels read_wheels(const fs::path& path, const WheelSelection& selection) {
  ImportedWheels wheels = read(path, selection);
  orient(wheels.track, selection);
  return wheels;
}

}  // namespace astro::importing
