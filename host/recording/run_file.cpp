#include "host/recording/run_file.hpp"

#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "host/base/byte_source.hpp"
#include "host/base/error.hpp"
#include "host/formats/files/mcap_reader.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/recording/run_metadata.hpp"
#include "host/recording/run_order.hpp"
#include "host/recording/run_writer.hpp"
#include "host/recording/sample_messages.hpp"

namespace astro::recording {
namespace {

/// The most samples that are read from a file: this number, plus one for each kLeastBytesPerSample bytes of
/// it. The recording of a robot that stands still compresses best: its messages differ only in their times
/// and take 26 bytes each.
constexpr std::size_t kFreeSamples = 300'000, kLeastBytesPerSample = 20;

/// The samples of a file's messages, before poses and counts are paired.
struct Streams {
  std::string file;
  std::size_t most = 0;  // samples
  // A deque, because a vector that grows by doubling would for a moment take three times the memory of its
  // samples.
  std::deque<OdometrySample> odometry;
  std::deque<recording::WheelCounts> counts;
  std::deque<TruthSample> truth;
  std::deque<lidar::Scan> scans;
  std::deque<GyroPose> gyro;
  std::deque<GyroSlip> slips;
  bool unreadable = false;

  template <class T>
  void keep(std::deque<T>& stream, std::optional<T> sample) {
    if (odometry.size() + counts.size() + truth.size() + scans.size() + gyro.size() + slips.size() >= most)
      throw Error(file + " holds more samples than any drive whose recording has its size: it is damaged",
                  RecordingProblem::too_many_samples, {file});
    if (sample)
      stream.push_back(std::move(*sample));
    else
      unreadable = true;
  }
  void take(const bag::mcap::Channel& channel, const bag::mcap::Schema* schema,
            const bag::mcap::Message& message) {
    if (schema == nullptr || channel.message_encoding != "cdr") return;
    if (schema->name == ros2::odometry_type().name && channel.topic == "/odom") {
      keep(odometry, recording::decode_odometry(message.data));
    } else if (schema->name == ros2::odometry_type().name && channel.topic == "/odom_gyro") {
      keep(gyro, recording::decode_gyro_pose(message.data));
    } else if (schema->name == recording::wheel_counts_type().name && channel.topic == "/wheel_counts") {
      keep(counts, recording::decode_counts(message.data));
    } else if (schema->name == ros2::pose_stamped_type().name && channel.topic == "/truth") {
      keep(truth, recording::decode_truth(message.data));
    } else if (schema->name == recording::laser_scan_type().name && channel.topic == "/scan") {
      keep(scans, recording::decode_scan(message.data));
    } else if (schema->name == recording::gyro_slip_type().name && channel.topic == "/gyro_slip") {
      keep(slips, recording::decode_slip(message.data));
    }
  }
};

struct RunFile {
  RunRecord record;
  Streams streams;
  std::optional<Remark> warning;
};

/// The warning for a file that is not complete.
std::optional<Remark> warning_of(const std::string& file, const bag::McapReport& report, Damage damage) {
  if (!report.is_mcap)
    throw Error(file + " is not an MCAP file: name a recording made by Astrolabe", RecordingProblem::not_mcap,
                {file});
  const Remark first = report.warnings.empty() ? Remark{} : report.warnings.front();
  const std::string damaged = file + " is damaged (" + first.sentence + ")";
  std::vector<std::string> values{file};
  values.insert(values.end(), first.values.begin(), first.values.end());
  if (report.damaged && damage == Damage::refused)
    throw DamagedRecording(damaged + ": copy it again from where it was recorded, or record the run again",
                           first.kind, values);
  if (report.damaged)
    return Remark{damaged + ": some of the run is missing, and results from it may be wrong", first.kind,
                  values};
  if (report.truncated)
    return Remark{file + " was cut off while it was recorded: what was driven last is missing",
                  RecordingProblem::cut_off,
                  {file}};
  return std::nullopt;
}

/// Reads the file; `handlers` has no handler of metadata yet. Returns its run record.
RunRecord record_in(ByteSource& source, const std::string& file, Damage damage, bag::McapHandlers handlers,
                    std::optional<Remark>& warning) {
  std::optional<bag::mcap::Map> entries;
  // The last record counts: the first is written before the run, the last after it.
  handlers.metadata = [&](const bag::mcap::Metadata& metadata) {
    if (metadata.name == kRunRecordName) entries = metadata.entries;
  };
  warning = warning_of(file, bag::read_mcap(source, handlers), damage);
  if (!entries) {
    throw Error(file + " is not a recording of a run (it has no record " + std::string(kRunRecordName) +
                    "): name a recording made by Astrolabe",
                RecordingProblem::of_no_run, {file});
  }
  return run_record(*entries, file);
}

RunFile parse(ByteSource& source, const std::string& file, Damage damage) {
  RunFile out;
  out.streams.file = file;
  out.streams.most = kFreeSamples + static_cast<std::size_t>(source.size()) / kLeastBytesPerSample;
  bag::McapHandlers handlers;
  handlers.message = [&](const bag::mcap::Channel& channel, const bag::mcap::Schema* schema,
                         const bag::mcap::Message& message) { out.streams.take(channel, schema, message); };
  out.record = record_in(source, file, damage, handlers, out.warning);
  return out;
}

/// For a damaged file: removes poses without counts and counts without poses.
void drop_singles(Streams& streams) {
  std::set<std::int64_t> poses, counts;
  for (const OdometrySample& sample : streams.odometry) poses.insert(sample.time_us);
  for (const recording::WheelCounts& sample : streams.counts) counts.insert(sample.time_us);
  std::erase_if(streams.odometry, [&](const auto& sample) { return !counts.contains(sample.time_us); });
  std::erase_if(streams.counts, [&](const auto& sample) { return !poses.contains(sample.time_us); });
}

/// Adds to every pose the counts of the same instant; the writer writes them in pairs.
void pair_counts(const std::string& file, bool cut_off, Streams& streams) {
  const std::size_t pairs = std::min(streams.odometry.size(), streams.counts.size());
  bool good = !streams.unreadable && (cut_off || streams.odometry.size() == streams.counts.size());
  for (std::size_t i = 0; i < pairs && good; ++i) {
    good = streams.odometry[i].time_us == streams.counts[i].time_us;
    streams.odometry[i].left_counts = streams.counts[i].left;
    streams.odometry[i].right_counts = streams.counts[i].right;
  }
  if (!good) {
    throw Error(file + " holds messages that do not belong to a run (the poses of /odom do not match the " +
                    "counts of /wheel_counts): the file was edited; use the original",
                RecordingProblem::poses_without_counts, {file});
  }
  streams.odometry.resize(pairs);
}

/// Moves the samples into a vector; the deque's memory is freed while the vector is filled.
template <class Sample>
std::vector<Sample> drained(std::deque<Sample>& samples) {
  std::vector<Sample> all;
  all.reserve(samples.size());
  for (; !samples.empty(); samples.pop_front()) all.push_back(std::move(samples.front()));
  return all;
}

/// Makes headings continuous: each within half a turn of the last finite one; the first one equals
/// `first_rad` except for rounding.
template <class Sample>
void unwrap(std::deque<Sample>& samples, const std::optional<double>& first_rad) {
  double last_rad = first_rad.value_or(std::numeric_limits<double>::quiet_NaN());
  for (Sample& sample : samples) {
    if (!std::isfinite(sample.theta_rad)) continue;
    if (std::isfinite(last_rad)) {
      const double turns = std::round((last_rad - sample.theta_rad) / (2 * std::numbers::pi));
      sample.theta_rad += turns * (2 * std::numbers::pi);
    }
    last_rad = sample.theta_rad;
  }
}

/// The same for the headings with the gyro, each within half a turn of the one before, as far from the wheels' next heading as that
/// one was. Behind the last one of the wheels, which a file that was cut off may lack, that one counts.
void unwrap_gyro(std::deque<GyroPose>& poses, const std::deque<OdometrySample>& odometry) {
  if (odometry.empty()) return;
  double apart_rad = 0;
  auto wheels = odometry.begin();
  for (GyroPose& pose : poses) {
    while (wheels + 1 != odometry.end() && wheels->time_us < pose.time_us) ++wheels;
    if (!std::isfinite(pose.theta_rad) || !std::isfinite(wheels->theta_rad)) continue;
    const double off_rad = pose.theta_rad - wheels->theta_rad - apart_rad;
    pose.theta_rad -= std::round(off_rad / (2 * std::numbers::pi)) * (2 * std::numbers::pi);
    apart_rad = pose.theta_rad - wheels->theta_rad;
  }
}

Run run_in(ByteSource& source, const std::string& name, Damage damage) {
  RunFile file = parse(source, name, damage);
  if (damage == Damage::accepted && file.warning) drop_singles(file.streams);
  pair_counts(name, file.warning.has_value(), file.streams);
  unwrap(file.streams.odometry, file.record.first_odometry_heading_rad);
  unwrap_gyro(file.streams.gyro, file.streams.odometry);
  unwrap(file.streams.truth, file.record.first_truth_heading_rad);
  file.streams.counts = {};
  return {std::move(file.record.info), drained(file.streams.odometry), drained(file.streams.truth),
          std::move(file.warning),     drained(file.streams.scans),    drained(file.streams.slips),
          drained(file.streams.gyro)};
}

}  // namespace

void write_run(const std::filesystem::path& path, const Run& run) {
  RunWriter writer(path, run.info);
  for_each_in_order(run, [&](const auto& sample) { writer.add(sample); });
  writer.close(run.info);
}

Run run_from_bytes(ByteView bytes, const std::string& name, Damage damage) {
  MemorySource source(bytes);
  return run_in(source, name, damage);
}

Run read_run(const std::filesystem::path& path, Damage damage) {
  FileSource source(path);
  return run_in(source, path.string(), damage);
}

RunInfo read_run_info(const std::filesystem::path& path) {
  FileSource source(path);
  std::optional<Remark> warning;
  return record_in(source, path.string(), Damage::accepted, {}, warning).info;
}

}  // namespace astro::recording
