#include "host/page/calls/inspect.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/tables/table.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/import/drives/file_pairs.hpp"
#include "host/import/drives/inspection_json.hpp"
#include "host/import/drives/stated_drives.hpp"
#include "host/import/wheels/travel_measure.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/page/calls/question.hpp"
#include "host/page/calls/remedies.hpp"
#include "host/page/calls/statements.hpp"
#include "host/truth/files/tracker_file.hpp"

namespace astro::page {
namespace {

using importing::FileInspection;
using importing::StatedDrives;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMostPoints = 600, kRowsShown = 4, kMostColumns = 100;

json problem_of(const Error& error) { return {{"sentence", error.what()}, {"remedies", remedies(error)}}; }

/// What a file is taken for.
struct Role {
  bool wheels = false, truth = false, robot = false;
};

Role role_named(const std::string& name) {
  if (name == "wheels") return {true, false};
  if (name == "truth") return {false, true};
  if (name == "both") return {true, true};
  if (name == "none") return {};
  throw Error("a file can be wheels, truth, both or none, and not '" + name + "'");
}

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

/// One file, as far as it can be read.
class File {
 public:
  File(fs::path path, std::optional<Role> role, const StatedDrives& stated)
      : path_(std::move(path)), stated_(stated) {
    if (role)
      role_ = *role;
    else
      recognise();
    if (role_.wheels || role_.truth) look();
  }

  importing::OfferedFile offered() const { return {path_, role_.wheels, role_.truth}; }
  json answer() const {
    const bool text = inspection_.is_null() || inspection_.value("kind", "") != "bag";
    return {{"name", path_.filename().string()},
            {"wheels", role_.wheels},
            {"truth", role_.truth},
            {"robot", role_.robot},
            {"inspection", inspection_},
            {"problem", problem_},
            {"table", text && !role_.robot ? table_of(path_) : json()},
            {"preview", preview_}};
  }

 private:
  /// A table whose columns are not clear is one of wheels, because recordings of trackers are known by their form.
  void recognise() try {
    const FileInspection found = importing::inspect_file(path_);
    inspection_ = importing::inspection_json(found);
    role_ = role_of(found);
  } catch (const Error& error) {
    problem_ = problem_of(error);
    role_.wheels = error.kind() == importing::WheelProblem::columns_unclear;
  }

  void look() try {
    problem_ = nullptr;
    const importing::ImportChoices choices = importing::choices_of(stated_);
    if (!bag::is_bag(path_)) inspection_ = inspected(choices);
    if (role_.wheels) preview_["wheels"] = preview_of(importing::read_wheels(path_, choices.wheels).track);
    if (role_.truth) preview_["truth"] = preview_of(importing::read_truth(path_, choices.truth).track);
    if (bag::is_bag(path_) && inspection_.is_null())
      inspection_ = importing::inspection_json(importing::inspect_file(path_));
  } catch (const Error& error) {
    problem_ = problem_of(error);
  }

  json inspected(const importing::ImportChoices& choices) const {
    const bool stated_truth = role_.truth && !role_.wheels;
    return importing::inspection_json(
        importing::inspect_file(path_, role_.wheels ? choices.wheels.table : importing::WheelTable{},
                                {.columns = stated_truth ? choices.truth.columns : ""}));
  }

  fs::path path_;
  const StatedDrives& stated_;
  Role role_;
  json inspection_, problem_, preview_ = json::object();
};

json units() {
  json wheels = json::array();
  for (const importing::TravelMeasure& measure : importing::travel_measures()) wheels.push_back(measure.name);
  return {{"wheels", wheels}, {"truth", importing::kTruthUnits}};
}

json column_roles() {
  const json times = {"time", "time_s", "time_ms", "time_us", "time_ns", "time_cs"};
  json wheels = times;
  for (const char* side : {"left_", "right_"})
    for (const importing::TravelMeasure& measure : importing::travel_measures()) {
      std::string name = side + std::string(measure.name);
      std::ranges::replace(name, '/', '_');
      wheels.push_back(name);
    }
  json truth = times;
  for (const std::string unit : importing::kTruthUnits)
    for (const char* axis : {"x_", "y_", "z_"}) truth.push_back(std::string(axis) + unit);
  for (const char* unit : {"rad", "deg"})
    for (const char* angle : {"theta_", "roll_", "pitch_", "yaw_"})
      truth.push_back(std::string(angle) + unit);
  for (const char* part : {"qx", "qy", "qz", "qw"}) truth.push_back(part);
  return {{"wheels", wheels}, {"truth", truth}};
}

}  // namespace

json inspect(const json& question, const fs::path& folder, const Emit&) {
  const StatedDrives stated = statements_in(question, folder);
  const json roles = question.value("roles", json::object());
  if (!roles.is_object()) throw Error("roles is no object");
  json files = json::array(), drives = json::array();
  std::vector<importing::OfferedFile> offered;
  for (const std::string& name : texts_in(question, "files")) {
    const std::string role = text_in(roles, name.c_str());
    const File file(file_in(folder, name), role.empty() ? std::nullopt : std::optional(role_named(role)),
                    stated);
    files.push_back(file.answer());
    offered.push_back(file.offered());
  }
  for (const importing::DriveFiles& drive : importing::pair_files(offered))
    drives.push_back(
        {{"wheels", drive.wheels.filename().string()}, {"truth", drive.truth.filename().string()}});
  return {{"files", files}, {"drives", drives}, {"roles", column_roles()}, {"units", units()}};
}

}  // namespace astro::page
