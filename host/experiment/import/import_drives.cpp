#include "host/experiment/import/import_drives.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "host/base/error.hpp"
#include "host/experiment/import/described_geometry.hpp"
#include "host/experiment/import/wheel_run.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

/// The last `parts` parts of the path, without the extension.
std::string name_of(const fs::path& path, std::size_t parts) {
  const fs::path whole = fs::absolute(path).lexically_normal();
  fs::path name = (whole.has_filename() ? whole : whole.parent_path()).filename().replace_extension();
  fs::path folder = (whole.has_filename() ? whole : whole.parent_path()).parent_path();
  for (; parts > 1 && folder.has_filename(); --parts, folder = folder.parent_path())
    name = folder.filename() / name;
  return name.string();
}

/// As short as they can be without being equal.
std::vector<std::string> names_of(std::span<const DriveFiles> files) {
  constexpr std::size_t kMostParts = 8;
  for (std::size_t parts = 1;; ++parts) {
    std::vector<std::string> names;
    std::map<std::string, int> uses;
    for (const DriveFiles& one : files) ++uses[names.emplace_back(name_of(one.wheels, parts))];
    if (uses.size() == files.size()) return names;
    if (parts < kMostParts) continue;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (uses[names[i]] > 1) names[i] += " (" + std::to_string(i + 1) + ")";
    return names;
  }
}

void refuse_twins(std::span<const DriveFiles> files) {
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (fs::weakly_canonical(files[i].wheels) == fs::weakly_canonical(files[j].wheels))
        throw Error("'" + files[i].wheels.string() +
                        "' is given twice, and a drive that counts twice would seem more certain than it is",
                    {Help::name_other_file});
}

/// A copy under another name would count twice as well.
void refuse_copy(const recording::Run& run, std::span<const recording::Run> others, const std::string& name,
                 std::span<const std::string> names) {
  const auto same_wheels = [](const recording::OdometrySample& a, const recording::OdometrySample& b) {
    return a.time_us == b.time_us && a.left_counts == b.left_counts && a.right_counts == b.right_counts;
  };
  const auto same_truth = [](const recording::TruthSample& a, const recording::TruthSample& b) {
    return a.time_us == b.time_us && a.x_m == b.x_m && a.y_m == b.y_m;
  };
  for (std::size_t i = 0; i < others.size(); ++i)
    if (std::ranges::equal(run.odometry, others[i].odometry, same_wheels) &&
        std::ranges::equal(run.truth, others[i].truth, same_truth))
      throw Error("'" + name + "' is a copy of '" + names[i] +
                      "', and a drive that counts twice would seem more certain than it is",
                  {Help::name_other_file});
}

/// The robot's description is in the bag of each drive, or in that of an earlier one.
class Geometry {
 public:
  explicit Geometry(const RobotGeometry& given) : given_(given), last_(given) {}

  const RobotGeometry& of(const fs::path& file, ImportedWheels& wheels) {
    RobotGeometry described = completed_by_description(given_, file, wheels.track, wheels.track.remarks);
    if (described.wheel_diameter_m != given_.wheel_diameter_m || described.wheelbase_m != given_.wheelbase_m)
      last_ = std::move(described);
    return last_;
  }

 private:
  const RobotGeometry& given_;
  RobotGeometry last_;
};

/// The errors of pairing are about both files.
PairedDrive paired(const std::string& name, const DriveFiles& files, const ImportChoices& choices,
                   Geometry& geometry) {
  ImportedWheels wheels = read_wheels(files.wheels, choices.wheels);
  const RobotGeometry& sizes = geometry.of(files.wheels, wheels);
  const ImportedTruth truth = read_truth(files.truth, choices.truth);
  try {
    return pair_up(name, std::move(wheels), truth, sizes, choices.floor);
  } catch (const Error& error) {
    throw Error("'" + files.wheels.string() + "' with '" + files.truth.string() + "': " + error.what(),
                error.remedy());
  }
}

}  // namespace

ImportedDrives import_wheels(std::span<const fs::path> wheels, const ImportChoices& choices) {
  std::vector<DriveFiles> files;
  for (const fs::path& path : wheels) files.push_back({path, {}});
  refuse_twins(files);
  Geometry geometry(choices.geometry);
  ImportedDrives drives;
  drives.set.names = names_of(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    ImportedWheels read = read_wheels(files[i].wheels, choices.wheels);
    const RobotGeometry& sizes = geometry.of(files[i].wheels, read);
    WheelRun made = run_of_wheels(drives.set.names[i], std::move(read), sizes);
    refuse_copy(made.run, drives.set.runs, drives.set.names[i], drives.set.names);
    drives.set.runs.push_back(std::move(made.run));
    drives.reports.push_back({{}, std::move(made.summary), std::move(made.remarks)});
  }
  return drives;
}

ImportedDrives import_drives(std::span<const DriveFiles> files, const ImportChoices& choices) {
  refuse_twins(files);
  Geometry geometry(choices.geometry);
  ImportedDrives drives;
  drives.set.names = names_of(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    PairedDrive drive = paired(drives.set.names[i], files[i], choices, geometry);
    refuse_copy(drive.run, drives.set.runs, drives.set.names[i], drives.set.names);
    drives.set.runs.push_back(std::move(drive.run));
    drives.reports.push_back(std::move(drive.report));
  }
  return drives;
}

}  // namespace astro::experiment
