#include "host/truth/files/pose_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/truth/files/rotations.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::truth {
namespace {

/// Memory limit of the samples: this much plus nearly twice the size of the text. Putting them on the floor takes 152 bytes
/// for each sample of 72 bytes, so with this limit at most four times the size of the text and 64 MiB.
constexpr std::size_t kFreeSampleBytes = std::size_t{24} << 20;
constexpr double kSampleBytesPerByte = 1.85;

bool is_text(std::size_t slot) { return slot < kTextSlots; }

std::uint32_t bit(Slot slot) { return 1U << static_cast<unsigned>(slot); }

std::uint32_t bits_needed(const PoseColumns& columns) {
  std::uint32_t bits = 0;
  for (std::size_t i = kTextSlots; i < kSlots; ++i) bits |= columns.column[i] >= 0 ? 1U << i : 0;
  return bits;
}

}  // namespace

PoseRow::PoseRow(const PoseColumns& columns) : columns_(columns), needed_(bits_needed(columns)) {
  for (std::size_t i = 0; i < kSlots; ++i) {
    if (columns.column[i] < 0) continue;
    const auto at = static_cast<std::size_t>(columns.column[i]);
    if (slot_of_.size() <= at) slot_of_.resize(at + 1, kSlots);
    slot_of_[at] = static_cast<std::uint8_t>(i);
  }
}

void PoseRow::read(const tables::Rows& rows) {
  present_ = 0;
  text_ = {};
  std::optional<std::string_view> rest = rows.text();
  const char separator = columns_.style.separator;
  std::string_view cell;
  for (std::size_t i = 0; i < slot_of_.size() && tables::take_cell(rest, separator, cell); ++i) {
    const std::size_t slot = slot_of_[i];
    if (slot == kSlots || cell.empty()) continue;
    if (is_text(slot)) {
      text_[slot] = cell;
      continue;
    }
    const auto value = tables::cell_number(cell, columns_.style);
    if (value) {
      number_[slot] = *value;
      present_ |= 1U << slot;
    } else if (cell != "nan" && cell != "NaN" && cell != "-nan") {
      rows.refuse(static_cast<int>(i) + 1, tables::shown_cell(cell) + " is not a number",
                  TrackProblem::not_a_number, {tables::cut_cell(cell)});
    }
  }
}

TrackedPose PoseRow::pose() const {
  TrackedPose out;
  out.valid = complete();
  if (!out.valid) return out;
  Pose3& p = out.pose;
  p.x_m = at(Slot::x) * columns_.metres;
  p.y_m = at(Slot::y) * columns_.metres;
  p.z_m = (present_ & bit(Slot::z)) != 0 ? at(Slot::z) * columns_.metres : 0;
  const double r = columns_.radians;
  switch (columns_.rotation) {
    case RotationKind::none:
      break;
    case RotationKind::quaternion:
      set_rotation(p, {at(Slot::rx), at(Slot::ry), at(Slot::rz), at(Slot::rw)});
      break;
    case RotationKind::euler:
      set_rotation(p,
                   from_euler(columns_.euler_order, {r * at(Slot::rx), r * at(Slot::ry), r * at(Slot::rz)}));
      break;
    case RotationKind::heading:
      set_rotation(p, from_euler("Z", {0, 0, r * at(Slot::heading)}));
      break;
    case RotationKind::rotation_vector:
      break;
  }
  out.valid = is_possible(p);
  if (out.valid && columns_.rotation == RotationKind::quaternion) normalise(p);
  if (columns_.rotation == RotationKind::rotation_vector) {
    set_rotation(p, {r * at(Slot::rx), r * at(Slot::ry), r * at(Slot::rz), 0});
    out.valid = out.valid && std::abs(p.qx) + std::abs(p.qy) + std::abs(p.qz) < 1e4;
  }
  return out;
}

TrackBuilder::TrackBuilder(BodyTrack& track, std::string_view text) : track_(track) {
  const auto by_text = static_cast<std::size_t>(kSampleBytesPerByte * static_cast<double>(text.size()));
  most_ = (kFreeSampleBytes + by_text) / sizeof(TrackedPose);
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  track_.samples.reserve(std::min(most_, lines + 1));
}

void TrackBuilder::add_stamped(const TrackedPose& sample, const tables::Rows& rows) {
  if (track_.samples.size() >= most_)
    rows.refuse("the file has more rows than can be held: split it into one file for each run");
  const bool changed = !track_.samples.empty() && sample.pose != track_.samples.back().pose;
  row_times_.take(sample.time_ns, rows.line(), changed);
  track_.samples.push_back(sample);
}

void TrackBuilder::add(const TrackedPose& sample, const tables::Rows& rows) {
  if (!track_.samples.empty() && sample.time_ns < track_.samples.back().time_ns)
    rows.refuse(tables::TimeFall{rows.line(), 1e-9 * static_cast<double>(track_.samples.back().time_ns),
                                 1e-9 * static_cast<double>(sample.time_ns)}
                    .text(),
                TrackProblem::time_not_increasing);
  add_stamped(sample, rows);
}

void TrackBuilder::finish(std::string_view file) {
  std::vector<TrackedPose>& samples = track_.samples;
  std::vector<Remark>& remarks = track_.facts.remarks;
  const tables::SettledTimes settled = row_times_.settle(samples, "the ground truth", remarks);
  if (settled.fall)
    throw Error(fmt::format("{}, line {}: {}", file, settled.fall->line, settled.fall->text()),
                TrackProblem::time_not_increasing, {std::string(file), std::to_string(settled.fall->line)});
  if (settled.too_coarse)
    throw Error(fmt::format("'{}': {} % of the poses repeat the time of the one before, and not evenly, so "
                            "that their times are not known",
                            file, row_times_.percent_repeated()),
                TrackProblem::times_too_coarse, {std::string(file), row_times_.percent_repeated()});
  if (settled.spread) {
    const std::string rows = fmt::format("{:.3g}", settled.spread->rows_in_step),
                      step_s = fmt::format("{:.3g}", settled.spread->step_s);
    remarks.push_back({fmt::format("there are {} poses of each time, which are {} s apart; they were spread "
                                   "evenly in between",
                                   rows, step_s),
                       TrackRemark::times_spread,
                       {rows, step_s}});
  }
  const auto same = [](const TrackedPose& a, const TrackedPose& b) { return a.time_ns == b.time_ns; };
  const auto kept = std::unique(samples.begin(), samples.end(), same);
  if (kept == samples.end()) return;
  const std::string rows = std::to_string(samples.end() - kept);
  remarks.push_back({"rows left out because they have the time of the row before: " + rows,
                     TrackRemark::times_repeated,
                     {rows}});
  samples.erase(kept, samples.end());
}

}  // namespace astro::truth
