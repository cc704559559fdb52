#include "host/truth/files/motive_csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "host/base/text/numbers.hpp"
#include "host/formats/tables/units.hpp"
#include "host/truth/files/frame_numbers.hpp"
#include "host/truth/files/motive_header.hpp"
#include "host/truth/files/rotations.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::truth {
namespace {

/// The time column is rounded to 1 ms in some versions.
constexpr double kTimeRounding_s = 1.05e-3;

PoseColumns motive_columns(const MotiveHeader& header, const MotiveBody& body, const std::string& order,
                           const tables::Rows& rows) {
  PoseColumns columns;
  columns.style = header.separator;
  columns[Slot::frame] = header.frame_column;
  columns[Slot::time] = header.time_column;
  constexpr Slot kPosition[] = {Slot::x, Slot::y, Slot::z};
  constexpr Slot kRotation[] = {Slot::rx, Slot::ry, Slot::rz, Slot::rw};
  for (std::size_t i = 0; i < 3; ++i) columns[kPosition[i]] = body.position[i];
  for (std::size_t i = 0; i < 4; ++i) columns[kRotation[i]] = body.rotation[i];
  const bool turns =
      std::all_of(body.rotation.begin(), body.rotation.begin() + 3, [](int i) { return i >= 0; });
  if (turns && body.rotation[3] >= 0) {
    columns.rotation = RotationKind::quaternion;
  } else if (turns && is_euler_order(order)) {
    columns.rotation = RotationKind::euler;
    columns.euler_order = order;
    columns.radians = *tables::radians_per("deg");
  } else if (turns) {
    rows.refuse("the rotation is given by three angles, but the rotation type '" + order.substr(0, 40) +
                "' is no order of axes such as XYZ");
  } else {
    for (const Slot slot : kRotation) columns[slot] = -1;
  }
  const std::string unit = header.value("Length Units");
  const auto metres = tables::metres_per(unit);
  if (!unit.empty() && !metres)
    rows.refuse("the unit of length " + tables::shown_cell(unit) + " is not known",
                TrackProblem::length_unit_unknown, {tables::cut_cell(unit)});
  columns.metres = metres.value_or(1);
  return columns;
}

std::string rotation_text(const PoseColumns& columns) {
  if (columns.rotation == RotationKind::quaternion) return "quaternion";
  if (columns.rotation == RotationKind::none) return "none";
  return "Euler angles " + std::string(columns.euler_order) + " in degrees";
}

/// Frame numbers and times of the rows, checked against one another.
class MotiveTimes {
 public:
  explicit MotiveTimes(const MotiveHeader& header) : separator_(header.separator), frames_(separator_) {
    rate_hz_ = header.number("Export Frame Rate");
    if (rate_hz_ <= 0) rate_hz_ = header.number("Capture Frame Rate");
  }
  double rate_hz() const { return rate_hz_; }
  std::int64_t dropped() const { return frames_.dropped(); }
  double disagreement_s() const { return disagreement_s_; }

  std::int64_t take(const PoseRow& row, const tables::Rows& rows) {
    const std::int64_t frame = frames_.take(row.frame(), rows);
    const auto column_ns = tables::exact_ns(row.time(), 9, separator_);
    if (rate_hz_ <= 0) {
      if (!column_ns) rows.refuse(2, "there is no time, and the header states no frame rate");
      return *column_ns;
    }
    const std::int64_t time_ns = frame_time_ns(frame, rate_hz_, rows);
    if (column_ns)
      disagreement_s_ = std::max(disagreement_s_, 1e-9 * std::abs(static_cast<double>(*column_ns - time_ns)));
    return time_ns;
  }

 private:
  char separator_;
  FrameNumbers frames_;
  double rate_hz_ = 0, disagreement_s_ = 0;
};

/// The hour of a time code "15:26:46:12.02" in a row; -1 if there is none.
int hour_of_time_code(const tables::Rows& rows, const MotiveHeader& header) {
  std::optional<std::string_view> rest = rows.text();
  std::string_view cell;
  for (int i = 0; i <= header.time_code_column; ++i) {
    if (!tables::take_cell(rest, header.separator, cell)) return -1;
  }
  int hour = -1;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), hour);
  return error == std::errc{} && end != cell.data() + cell.size() && *end == ':' && hour < 24 ? hour : -1;
}

/// Completes a time on a twelve-hour clock by the hour of a time code.
void settle_half_day(TrackFacts& facts, int hour) {
  if (facts.start_time_sure || hour < 0 || facts.start_time.size() < 13) return;
  int stated = (facts.start_time[11] - '0') * 10 + facts.start_time[12] - '0';
  if (std::abs(hour - stated) % 12 > 1 && std::abs(hour - stated) % 12 < 11) return;  // another clock
  if (std::abs(hour - stated) > 6) stated = (stated + 12) % 24;
  facts.start_time[11] = static_cast<char>('0' + stated / 10);
  facts.start_time[12] = static_cast<char>('0' + stated % 10);
  facts.start_time_sure = true;
}

void describe(const MotiveHeader& header, const PoseColumns& columns, TrackFacts& facts) {
  facts.kind = FileKind::motive;
  facts.format = "Motive CSV " + header.value("Format Version").substr(0, 20);
  facts.length_unit = header.value("Length Units");
  facts.rotation_kind = columns.rotation;
  facts.rotation = rotation_text(columns);
  facts.start_time = motive_start_time(header.value("Capture Start Time"), facts.start_time_sure);
}

void add_remarks(const MotiveHeader& header, const MotiveTimes& times, TrackFacts& facts) {
  facts.rate_hz = times.rate_hz();
  facts.dropped_frames = times.dropped();
  const std::string most_ms = to_text(std::round(1e3 * times.disagreement_s()));
  if (times.disagreement_s() > kTimeRounding_s)
    facts.remarks.push_back({"frame numbers and the column of times differ by up to " + most_ms +
                                 " ms; the frame numbers are used",
                             TrackRemark::times_disagree,
                             {most_ms}});
  const std::string space = header.value("Coordinate Space");
  if (!space.empty() && space != "Global")
    facts.remarks.push_back({"the coordinate space is '" + space.substr(0, 40) + "', not Global"});
}

}  // namespace

std::vector<BodyName> bodies_in_motive(std::string_view text, std::string_view file) {
  tables::Rows rows(text, file);
  std::vector<BodyName> names;
  for (const MotiveBody& body : read_motive_header(rows).bodies) names.push_back(body.name);
  return names;
}

BodyTrack read_motive(std::string_view text, std::string_view file, std::string_view body) {
  tables::Rows rows(text, file);
  const MotiveHeader header = read_motive_header(rows);
  std::vector<BodyName> names;
  for (const MotiveBody& one : header.bodies) names.push_back(one.name);
  const MotiveBody& chosen = header.bodies[choose_body(names, body, file)];
  const std::string order = header.value("Rotation Type");
  const PoseColumns columns = motive_columns(header, chosen, order, rows);
  BodyTrack track;
  track.name = chosen.name.name;
  track.id = chosen.name.id;
  describe(header, columns, track.facts);
  PoseRow row(columns);
  MotiveTimes times(header);
  TrackBuilder builder(track, text);
  while (rows.next_filled()) {
    if (track.samples.empty() && header.time_code_column >= 0)
      settle_half_day(track.facts, hour_of_time_code(rows, header));
    row.read(rows);
    TrackedPose sample = row.pose();
    sample.time_ns = times.take(row, rows);
    builder.add(sample, rows);
  }
  add_remarks(header, times, track.facts);
  builder.finish(file);
  return track;
}

std::string motive_start_time(std::string_view text, bool& sure) {
  sure = true;
  // "2020-12-23 01.18.10.123", then perhaps a word for the half of the day
  constexpr std::string_view kForm = "dddd-dd-dd dd.dd.dd.ddd";
  if (text.size() < kForm.size()) return "";
  std::string out(text.substr(0, kForm.size()));
  for (std::size_t i = 0; i < kForm.size(); ++i) {
    const bool digit = out[i] >= '0' && out[i] <= '9';
    if (kForm[i] == 'd' ? !digit : out[i] != kForm[i]) return "";
  }
  out[10] = 'T';
  out[13] = out[16] = ':';
  const int stated = (out[11] - '0') * 10 + out[12] - '0';
  std::string_view word = text.substr(kForm.size());
  while (!word.empty() && word.front() == ' ') word.remove_prefix(1);
  const bool afternoon = word == "PM" || word == "P.M." || word == "pm" || word == "p. m." || word == "DU.";
  const bool morning = word == "AM" || word == "A.M." || word == "am" || word == "a. m." || word == "DE.";
  sure = afternoon || morning || stated == 0 || stated > 12;
  const int hour = afternoon && stated < 12 ? stated + 12 : morning && stated == 12 ? 0 : stated;
  out[11] = static_cast<char>('0' + hour / 10);
  out[12] = static_cast<char>('0' + hour % 10);
  return out;
}

}  // namespace astro::truth
