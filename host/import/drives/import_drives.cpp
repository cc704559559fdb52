#include "host/import/drives/import_drives.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/import/drives/drive_pair.hpp"
#include "host/import/drives/recorded_sizes.hpp"
#include "host/import/drives/wheel_doubts.hpp"
#include "host/import/drives/wheel_run.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/truth/floor/lost_tracking.hpp"

namespace astro::importing {
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

/// Names as short as possible, but distinct.
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
                        "' is given twice, and a drive that counts twice would seem more certain than it is: "
                        "name another file",
                    ImportProblem::given_twice, {files[i].wheels.string()});
}

/// Refuses a copy under another name, because the drive would count twice.
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
      throw Error(
          "'" + name + "' is a copy of '" + names[i] +
              "', and a drive that counts twice would seem more certain than it is: name another file",
          ImportProblem::copy_of_other, {name, names[i]});
}

/// The wheels of a drive alone, as one without ground truth.
PairedDrive unpaired(const std::string& name, const DriveFiles& files, const ImportChoices& choices,
                     RecordedSizes& geometry) {
  ImportedWheels wheels = read_wheels(files.wheels, choices.wheels);
  const std::optional<double> counter_range = wheels.track.counter_range;
  const RobotGeometry& sizes = geometry.of(files.wheels, wheels);
  WheelRun made = run_of_wheels(name, std::move(wheels), sizes, choices.wheels.imu_axis);
  return {std::move(made.run), {{}, std::move(made.summary), std::move(made.remarks)}, counter_range};
}

/// Reads all drives. What one of them does not show is taken from the others.
class AllDrives {
 public:
  using Reader = decltype(paired);

  /// `reader` reads one of them.
  AllDrives(Reader& reader, std::span<const DriveFiles> files, const ImportChoices& choices)
      : reader_(reader),
        files_(files),
        choices_(files.size(), choices),
        geometry_(choices.geometry),
        names_(names_of(files)) {}

  std::vector<PairedDrive> read() {
    for (std::size_t i = 0; i < files_.size(); ++i) read(i);
    take_range_of_others();
    take_up_axis_of_others();
    std::vector<PairedDrive> drives;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (failed_[i]) throw Error(*failed_[i]);
      drives.push_back(std::move(*drives_[i]));
    }
    return drives;
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  static bool is_of_counter(Kind kind) {
    return kind == CounterProblem::starts_again || kind == CounterProblem::range_unknown ||
           kind == ImportProblem::leaps;
  }

  void read(std::size_t i) try {
    drives_[i] = reader_(names_[i], files_[i], choices_[i], geometry_);
    failed_[i].reset();
  } catch (const Error& error) {
    if (error.kind() != truth::FloorProblem::no_up_axis && !is_of_counter(error.kind())) throw;
    failed_[i] = error;
  }

  /// A counter that came to its end once or twice in a drive may not show its range; in longer drives it does.
  void take_range_of_others() {
    std::optional<double> range;
    for (const auto& drive : drives_) {
      if (!drive || !drive->counter_range) continue;
      if (range && range != drive->counter_range) return;
      range = drive->counter_range;
    }
    if (!range) return;
    for (std::size_t i = 0; i < files_.size(); ++i)
      if (failed_[i] ? is_of_counter(failed_[i]->kind()) : has_joined_restart(*drives_[i]))
        read_with_range(i, *range);
  }

  /// A range that does not fit this drive is not its own, and leaves it as it was.
  void read_with_range(std::size_t i, double range) {
    ImportChoices before = choices_[i];
    choices_[i].wheels.table.counter_range = choices_[i].wheels.bag.counter_range = range;
    std::optional<PairedDrive> first = std::exchange(drives_[i], std::nullopt);
    std::optional<Error> why = failed_[i];
    try {
      read(i);
      if (drives_[i] || !first) return;
    } catch (const Error& error) {
      if (!first && error.kind() != CounterProblem::beyond_range) throw;
    }
    choices_[i] = std::move(before);
    drives_[i] = std::move(first);
    failed_[i] = std::move(why);
  }

  static bool has_joined_restart(const PairedDrive& drive) {
    return std::ranges::any_of(drive.report.remarks, [](const Remark& remark) {
      return remark.kind == WheelRemark::restart_joined;
    });
  }

  /// A drive on a line does not show which axis is up; the others of the same tracker do.
  void take_up_axis_of_others() {
    const auto shows =
        std::find_if(drives_.begin(), drives_.end(), [](const auto& drive) { return drive.has_value(); });
    if (shows == drives_.end()) return;
    const truth::Direction3 up = (*shows)->report.floor.up;
    const std::string axis = truth::axis_text(up),
                      from = names_[static_cast<std::size_t>(shows - drives_.begin())];
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (!failed_[i] || failed_[i]->kind() != truth::FloorProblem::no_up_axis) continue;
      choices_[i].floor.up = up;
      read(i);
      if (failed_[i]) continue;
      drives_[i]->report.remarks.push_back(
          {"it does not show which axis points up; " + axis + " is taken, as in " + from,
           ImportProblem::up_axis_of_other,
           {names_[i], axis, from}});
    }
  }

  Reader& reader_;
  std::span<const DriveFiles> files_;
  std::vector<ImportChoices> choices_;  // of each drive
  RecordedSizes geometry_;
  std::vector<std::string> names_;
  std::vector<std::optional<PairedDrive>> drives_ = std::vector<std::optional<PairedDrive>>(files_.size());
  std::vector<std::optional<Error>> failed_ = std::vector<std::optional<Error>>(files_.size());
};

ImportedDrives collected(std::vector<PairedDrive> drives, const std::vector<std::string>& names) {
  ImportedDrives all;
  all.set.names = names;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    refuse_copy(drives[i].run, all.set.runs, names[i], names);
    all.set.runs.push_back(std::move(drives[i].run));
    all.reports.push_back(std::move(drives[i].report));
  }
  return all;
}

/// Wheels that are exchanged and reversed turn the robot as the truth does. Nothing but their direction shows it.
void refuse_backward(const std::vector<PairedDrive>& drives, const std::vector<std::string>& names,
                     const ImportChoices& choices) {
  const bool backward =
      std::all_of(drives.begin(), drives.end(), [](const auto& drive) { return drove_backward(drive.run); });
  if (backward && !choices.drives_backward && !drives.empty())
    throw Error("by its wheels the robot drove backward in " +
                    (drives.size() == 1 ? "'" + names.front() + "'" : "all drives"),
                ImportProblem::drives_backward, {names.front()});
}

template <class Sample>
void require_times(const std::vector<Sample>& samples, const std::string& what) {
  if (samples.size() < 2)
    throw Error(what + " must have at least two samples, and has " + std::to_string(samples.size()),
                ImportProblem::no_poses);
  const auto step_back = std::adjacent_find(
      samples.begin(), samples.end(), [](const auto& a, const auto& b) { return !(a.time_ns < b.time_ns); });
  if (step_back != samples.end())
    throw Error("the times of " + what + " must increase, and do not after row " +
                    std::to_string(step_back - samples.begin() + 1),
                ImportProblem::times_not_increasing);
}

}  // namespace

ImportedDrives import_wheels(std::span<const fs::path> wheels, const ImportChoices& choices) {
  std::vector<DriveFiles> files;
  for (const fs::path& path : wheels) files.push_back({path, {}});
  refuse_twins(files);
  AllDrives reader(unpaired, files, choices);
  return collected(reader.read(), reader.names());
}

ImportedDrives import_drives(std::span<const DriveFiles> files, const ImportChoices& choices) {
  refuse_twins(files);
  AllDrives reader(paired, files, choices);
  std::vector<PairedDrive> drives = reader.read();
  refuse_backward(drives, reader.names(), choices);
  return collected(std::move(drives), reader.names());
}

ImportedDrives import_held(std::vector<HeldDrive> held, const ImportChoices& choices) {
  std::vector<PairedDrive> drives;
  std::vector<std::string> names;
  for (HeldDrive& one : held) {
    try {
      require_times(one.wheels.track.samples, "the wheels");
      require_times(one.truth.samples, "the ground truth");
      orient(one.wheels.track, choices.wheels);
      ImportedTruth truth{std::move(one.truth), {}};
      truth.lost = truth::mark_lost(truth.track);
      drives.push_back(
          pair_up(one.name, {one.name, one.name}, std::move(one.wheels), truth, choices.geometry, choices));
    } catch (const Error& error) {
      throw Error(error.in("'" + one.name + "': "));
    }
    names.push_back(one.name);
  }
  refuse_backward(drives, names, choices);
  return collected(std::move(drives), names);
}

}  // namespace astro::importing
