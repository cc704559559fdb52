#include "host/page/calls/looked_file.hpp"

#include <algorithm>
#include <utility>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/tables/table.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/import/drives/inspection_json.hpp"
#include "host/import/scans/scanned_drives.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/page/calls/remedies.hpp"
#include "host/truth/files/tracker_file.hpp"

namespace astro::page {
namespace {

using importing::FileInspection;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMostPoints = 600, kRowsShown = 4, kMostColumns = 100;

json problem_of(const Error& error) { return {{"sentence", error.what()}, {"remedies", remedies(error)}}; }

Role role_of(const FileInspection& found) {
  if (!found.bag) return {found.wheels.has_value(), found.tracker.has_value(), found.robot.has_value()};
  const bool truth = found.bag->truth || !std::ranges::all_of(found.bag->poses, importing::is_estimate);
  return {found.bag->run || !found.bag->sources.empty(), found.bag->run || truth};
}

/// The rows between the first and the last, evenly, so that there are few enough to draw.
std::vector<std::size_t> drawn(std::size_t samples) {
  std::vector<std::size_t> rows;
  const std::size_t points = std::min(samples, kMostPoints);
  for (std::size_t i = 0; i < points; ++i) rows.push_back(points < 2 ? 0 : i * (samples - 1) / (points - 1));
  return rows;
}

json preview_of(const importing::WheelTrack& track) {
  json t_s = json::array(), left = json::array(), right = json::array();
  for (const std::size_t row : drawn(track.samples.size())) {
    const importing::WheelSample &at = track.samples[row], &first = track.samples.front();
    t_s.push_back(1e-9 * static_cast<double>(at.time_ns - first.time_ns));
    left.push_back(at.left - first.left);
    right.push_back(at.right - first.right);
  }
  return {{"t_s", t_s}, {"left", left}, {"right", right}, {"unit", unit_name(track.unit)}};
}

json preview_of(const truth::BodyTrack& track) {
  json t_s = json::array();
  json axes[] = {json::array(), json::array(), json::array()};
  for (const std::size_t row : drawn(track.samples.size())) {
    const truth::TrackedPose& at = track.samples[row];
    t_s.push_back(1e-9 * static_cast<double>(at.time_ns - track.samples.front().time_ns));
    const double position[] = {at.pose.x_m, at.pose.y_m, at.pose.z_m};
    for (std::size_t i = 0; i < 3; ++i) axes[i].push_back(at.valid ? json(position[i]) : json());
  }
  return {{"t_s", t_s}, {"x_m", axes[0]}, {"y_m", axes[1]}, {"z_m", axes[2]}};
}

json understood(importing::WheelTrack track) {
  FileInspection found;
  found.wheels = importing::inspect_wheels(std::move(track));
  return importing::inspection_json(found);
}

json understood(truth::BodyTrack track) {
  FileInspection found;
  found.tracker.emplace().bodies.push_back(truth::inspect(track));
  return importing::inspection_json(found).at("bodies").at(0);
}

/// Names and first rows of a table; null for any other file, as for the recording of a tracker whose form says what its columns
/// are.
json table_of(const fs::path& path) try {
  if (bag::is_bag(path)) return {};
  const Bytes bytes = tables::text_of_file(path);
  if (const truth::FileKind kind = truth::recognise(as_text(bytes));
      kind != truth::FileKind::unknown && kind != truth::FileKind::plain)
    return {};
  tables::Table table(as_text(bytes), path.string());
  const std::size_t columns = table.columns();
  if (columns < 2 || columns > kMostColumns) return {};
  json rows = json::array();
  while (rows.size() < kRowsShown && table.next()) {
    json row = json::array();
    for (std::size_t i = 0; i < columns; ++i) row.push_back(table.cell(i));
    rows.push_back(row);
  }
  if (rows.empty()) return {};
  return {{"names", table.names()}, {"columns", columns}, {"rows", rows}};
} catch (const Error&) {
  return {};
}

}  // namespace

Role role_named(const std::string& name) {
  if (name == "wheels") return {true, false};
  if (name == "truth") return {false, true};
  if (name == "both") return {true, true};
  if (name == "none") return {};
  throw Error("a file can be wheels, truth, both or none, and not '" + name + "'");
}

LookedFile::LookedFile(fs::path path, std::optional<Role> role, const importing::StatedDrives& stated,
                       const importing::ImportChoices& choices)
    : path_(std::move(path)), role_(role.value_or(Role{})) {
  recognise(role.has_value(), stated);
  if (role_.wheels || role_.truth) look(choices);
}

json LookedFile::answer() const {
  return {{"name", path_.filename().string()},
          {"wheels", role_.wheels},
          {"truth", role_.truth},
          {"scans", scans_},
          {"robot", role_.robot},
          {"controllers", controllers_},
          {"inspection", inspection_},
          {"understood", understood_},
          {"problem", problem_},
          {"table", role_.robot || scans_ ? json() : table_of(path_)},
          {"preview", preview_}};
}

/// A table whose columns are not clear is one of wheels, because recordings of trackers are known by their form.
void LookedFile::recognise(bool role_is_stated, const importing::StatedDrives& stated) try {
  scans_ = importing::gives_scans(path_, stated);
  if (scans_ && !role_is_stated) role_.truth = true;
  if (scans_ && !bag::is_bag(path_)) {
    role_.wheels = role_.truth;  // a log holds odometry as well
    return;
  }
  const FileInspection found = importing::inspect_file(path_);
  inspection_ = importing::inspection_json(found);
  if (role_is_stated) return;
  role_ = role_of(found);
  role_.truth = role_.truth || scans_;
} catch (const Error& error) {
  if (role_is_stated) return;
  problem_ = problem_of(error);
  role_.wheels = error.kind() == importing::WheelProblem::columns_unclear;
  if (error.kind() != importing::WheelProblem::controller_unclear || error.values().empty()) return;
  role_.robot = true;
  controllers_ = error.values();
  if (path_ != stated.robot_file || std::ranges::count(controllers_, stated.controller) == 0) return;
  FileInspection found;
  found.robot = importing::read_robot_file(path_, stated.controller);
  inspection_ = importing::inspection_json(found);
  problem_ = nullptr;
}

void LookedFile::look(const importing::ImportChoices& choices) try {
  problem_ = nullptr;
  const bool log = scans_ && !bag::is_bag(path_);
  if (role_.wheels && !log) {
    importing::WheelTrack track = importing::read_wheels(path_, choices.wheels).track;
    preview_["wheels"] = preview_of(track);
    understood_["wheels"] = understood(std::move(track));
  }
  if (role_.truth && !scans_) {
    truth::BodyTrack track = importing::read_truth(path_, choices.truth).track;
    preview_["truth"] = preview_of(track);
    understood_["truth"] = understood(std::move(track));
  }
} catch (const Error& error) {
  problem_ = problem_of(error);
}

}  // namespace astro::page
