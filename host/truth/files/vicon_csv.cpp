#include "host/truth/files/vicon_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/base/text/degrees.hpp"
#include "host/truth/files/frame_numbers.hpp"
#include "host/truth/files/rotations.hpp"
#include "host/truth/files/vicon_header.hpp"

namespace astro::truth {
namespace {

/// The mean squared tilt of the poses against a pure turn about one axis, for the best of the three axes.
template <class RotationAt>
double mean_tilt(const std::vector<TrackedPose>& samples, RotationAt rotation_at) {
  const auto first = std::find_if(samples.begin(), samples.end(), [](const auto& s) { return s.valid; });
  if (first == samples.end()) return 0;
  const Quaternion start = conjugate(rotation_at(first->pose));
  const std::size_t stride = samples.size() / 5000 + 1;
  double best = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < samples.size(); i += stride) {
      if (!samples[i].valid) continue;
      const double tilt = tilt_rad(rotation_at(samples[i].pose) * start, axis);
      sum += tilt * tilt;
      ++count;
    }
    best = std::min(best, count > 0 ? std::sqrt(sum / count) : 0);
  }
  return best;
}

/// Converts the three numbers of each pose by the reading that leaves the smaller tilt.
void settle_rotation(BodyTrack& track, const std::string& angle_unit) {
  const auto as_vector = [](const Pose3& p) { return from_rotation_vector({p.qx, p.qy, p.qz}); };
  const auto as_euler = [](const Pose3& p) { return from_euler("XYZ", {p.qx, p.qy, p.qz}); };
  const double vector_tilt = mean_tilt(track.samples, as_vector),
               euler_tilt = mean_tilt(track.samples, as_euler);
  const bool euler = euler_tilt < vector_tilt / 2;
  for (TrackedPose& sample : track.samples)
    set_rotation(sample.pose,
                 sample.valid ? euler ? as_euler(sample.pose) : as_vector(sample.pose) : Quaternion{});
  track.facts.rotation_kind = euler ? RotationKind::euler : RotationKind::rotation_vector;
  track.facts.rotation = (euler ? "Euler angles XYZ in " : "rotation vector in ") + angle_unit;
  if (!euler && vector_tilt > 0.1 && euler_tilt < 2 * vector_tilt)
    track.facts.remarks.push_back(
        {"the rotations tilt by " + fmt::format("{:.0f} degrees", degrees(vector_tilt)) +
         " as rotation vectors and by " + fmt::format("{:.0f} degrees", degrees(euler_tilt)) +
         " as Euler angles, so it is not sure which of the two they are"});
}

BodyTrack read_vicon_body(std::string_view text, std::string_view file, const ViconBody& body) {
  tables::Rows rows(text, file);
  while (rows.next() && rows.line() < body.section_line + 4) {
  }
  BodyTrack track;
  track.name = body.name.name;
  track.id = body.name.id;
  PoseRow row(body.columns);
  FrameNumbers frames(body.columns.style.separator);
  std::optional<std::int64_t> first;
  TrackBuilder builder(track, text);
  std::int64_t between = 0;
  while (rows.next() && !rows.is_blank()) {
    row.read(rows);
    if (!row.time().empty() && row.time() != "0") {
      ++between;
      continue;
    }
    TrackedPose sample = row.pose();
    const std::int64_t frame = frames.take(row.frame(), rows);
    if (!first) first = frame;
    sample.time_ns = frame_time_ns(frame - *first, body.rate_hz, rows);
    builder.add(sample, rows);
  }
  track.facts.dropped_frames = frames.dropped();
  builder.finish(file);
  if (between > 0)
    track.facts.remarks.push_back({std::to_string(between) + " rows of sub-frames were passed over"});
  return track;
}

}  // namespace

std::vector<BodyName> bodies_in_vicon(std::string_view text, std::string_view file) {
  std::vector<BodyName> names;
  for (const ViconBody& body : find_vicon_bodies(text, file)) names.push_back(body.name);
  return names;
}

BodyTrack read_vicon(std::string_view text, std::string_view file, std::string_view body) {
  const std::vector<ViconBody> bodies = find_vicon_bodies(text, file);
  std::vector<BodyName> names;
  for (const ViconBody& one : bodies) names.push_back(one.name);
  const ViconBody& chosen = bodies[choose_body(names, body, file)];
  BodyTrack track = read_vicon_body(text, file, chosen);
  TrackFacts& facts = track.facts;
  facts.kind = FileKind::vicon;
  facts.format = "Vicon CSV";
  facts.rate_hz = chosen.rate_hz;
  facts.length_unit = chosen.length_unit;
  facts.rotation_kind = chosen.columns.rotation;
  facts.rotation = chosen.columns.rotation == RotationKind::quaternion ? "quaternion" : "none";
  if (chosen.columns.rotation == RotationKind::rotation_vector) settle_rotation(track, chosen.angle_unit);
  return track;
}

}  // namespace astro::truth
