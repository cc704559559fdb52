#include "host/import/drives/import_drives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/messages/text_message.hpp"
#include "host/import/drives/wheel_doubts.hpp"
#include "host/import/drives/wheel_run.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/described_wheels.hpp"

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

constexpr std::size_t kLongestDescription = 4 << 20;  // bytes; meshes are in files of their own

struct Described {
  std::string topic, urdf;
};

/// Finds the last description with these joints: sizes may have been corrected while the robot drove.
std::optional<Described> description_in(const fs::path& bag, const JointPair& joints) {
  std::optional<Described> found;
  bag::BagHandlers handlers;
  handlers.wants = [](const bag::BagTopic& topic) {
    return topic.type == ros2::string_type().name && topic.encoding == "cdr" &&
           (topic.name == "robot_description" || topic.name.ends_with("/robot_description"));
  };
  handlers.message = [&](const bag::BagTopic& topic, const bag::BagMessage& message) {
    if (message.data.size() > kLongestDescription) return;
    auto urdf = ros2::decode_text(message.data);
    if (urdf && describes(*urdf, joints)) found = Described{topic.name, std::move(*urdf)};
  };
  bag::read_bag(bag, handlers);
  return found;
}

/// Completes `given` with wheel diameter and wheelbase from the robot's description (URDF) that was recorded
/// in the bag beside the wheels: the topic robot_description, in any namespace, whose description has the
/// joints of the wheels. A remark states the sizes.
///
/// Does not search if nothing is missing, or if `wheels` are not from a bag. Throws astro::Error naming the
/// bag if a description has the wheels but not their sizes, and what bag::read_bag throws.
RobotGeometry completed_by_description(RobotGeometry given, const fs::path& bag, const WheelTrack& wheels,
                                       std::vector<Remark>& remarks) {
  if ((given.wheel_diameter_m && given.wheelbase_m) || wheels.joints.left.empty()) return given;
  const std::optional<Described> found = description_in(bag, wheels.joints);
  if (!found) return given;
  DescribedWheels sizes;
  try {
    sizes = described_wheels(found->urdf, wheels.joints);
  } catch (const Error& error) {
    throw Error(fmt::format("{}, {}: {}", bag.string(), found->topic, error.what()),
                ImportProblem::sizes_not_described);
  }
  if (!given.wheel_diameter_m) given.wheel_diameter_m = 2 * sizes.radius_m;
  if (!given.wheelbase_m) given.wheelbase_m = sizes.separation_m;
  remarks.push_back({fmt::format("{} has wheels of {:.6g} m, {:.6g} m apart", found->topic,
                                 2 * sizes.radius_m, sizes.separation_m)});
  return given;
}

/// The geometry for each drive: the robot's description is in the bag of that drive, or in that of an earlier
/// one.
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

/// A drive whose wheels and whose ground truth other programs recorded.
struct PairedDrive {
  /// Like our own recordings: its odometry is dead reckoning with the factors of the geometry, its truth is
  /// the path on the floor, each with the times of its own clock ("tracker"). Angles and metres of travel are
  /// counts with kAngleCounts in a turn (analysis/trajectories.hpp).
  recording::Run run;
  DriveReport report;
  std::optional<double> counter_range;  // that the wheels showed
};

/// Times of wheels and tracker are as in their files: microseconds with any origin. If there are more than 40
/// minutes of samples at 100 Hz, several samples become one motion.
std::vector<truth::WheelMotion> motion_of(const std::vector<recording::OdometrySample>& odometry) {
  constexpr std::size_t kMostMotions = 250'000;
  const std::size_t stride = odometry.size() / kMostMotions + 1;
  std::vector<truth::WheelMotion> motion;
  motion.reserve(odometry.size() / stride);
  for (std::size_t last = stride; last < odometry.size(); last += stride) {
    truth::WheelMotion sum{
        0.5e-6 * static_cast<double>(odometry[last - stride].time_us + odometry[last].time_us), 0, 0};
    double span_s = 0;
    for (std::size_t i = last - stride + 1; i <= last; ++i) {
      const double dt_s = 1e-6 * static_cast<double>(odometry[i].time_us - odometry[i - 1].time_us);
      sum.speed_mps += dt_s * odometry[i].v_mps;
      sum.yaw_rate_radps += dt_s * odometry[i].omega_radps;
      span_s += dt_s;
    }
    if (!(span_s > 0)) continue;  // within one microsecond
    motion.push_back({sum.time_s, sum.speed_mps / span_s, sum.yaw_rate_radps / span_s});
  }
  return motion;
}

/// Whether by its wheels a robot drove backward, which hardly any does for long.
bool drove_backward(const recording::Run& run) {
  constexpr double kForTheMostPart = -0.3;  // spins and flickering counts go either way
  return forward_share(run) < kForTheMostPart;
}

/// `exchanged`: a person said that the file has left and right exchanged.
void settle_direction(const std::string& name, const recording::Run& run, bool exchanged,
                      const truth::FloorFindings& findings, std::vector<Remark>& remarks) {
  constexpr double kClear_m = 0.03;  // more than the usual height of a tracker's origin above its floor
  const std::string distance = fmt::format("{:.2f}", -findings.height_m);
  const auto kind = [&](ImportProblem problem) {
    return exchanged ? ImportProblem::turns_against_exchanged : problem;
  };
  // If the axis points down and the wheels are exchanged, both turn alike.
  if (!findings.turns_against_wheels && !findings.up_given && findings.height_m < -kClear_m)
    throw Error(
        fmt::format(
            "the body is {} m below the tracker's origin, so the axis that seems to point up may point down "
            "and the wheels may {}be exchanged",
            distance, exchanged ? "not " : ""),
        kind(ImportProblem::below_origin), {name, distance});
  if (!findings.turns_against_wheels) return;
  const std::string fact = "the wheels turn the robot the other way than the ground truth";
  if (!exchanged && findings.height_m <= kClear_m && drove_backward(run))
    throw Error(fact + ", and they count backward, so both encoders seem to be reversed",
                ImportProblem::encoders_reversed, {name});
  if (findings.up_given) throw Error(fact, kind(ImportProblem::turns_against_stated_up), {name});
  if (findings.height_m > kClear_m) {
    remarks.push_back({"the wheels show that the tracker's axis that seems to point up points down"});
    return;
  }
  if (findings.height_m < -kClear_m)
    throw Error(fmt::format("{}, and the body is {} m above the tracker's origin", fact, distance),
                kind(ImportProblem::turns_against_wheels), {name, distance});
  throw Error(fact + ", and nothing shows which of the two is a mirror image",
              kind(ImportProblem::turns_against_wheels), {name});
}

/// Samples in a second, from the first to the last.
template <class Sample>
double rate_hz(const std::vector<Sample>& samples) {
  const double span_s = 1e-9 * static_cast<double>(samples.back().time_ns - samples.front().time_ns);
  return span_s > 0 ? static_cast<double>(samples.size() - 1) / span_s : 0;
}

std::string summary_of(const ImportedTruth& truth, const truth::FloorFindings& floor) {
  const std::string text =
      fmt::format("; {} poses{} ({}) at {:.4g} Hz, {} lost", truth.track.samples.size(),
                  truth.track.name.empty() ? "" : " of '" + truth.track.name + "'", truth.track.facts.format,
                  rate_hz(truth.track.samples), truth.lost.all());
  return truth.track.facts.flat ? text : text + "; " + truth::axis_text(floor.up) + " is up";
}

/// The unit of time that was assumed, or "".
std::string assumed_in(const std::vector<Remark>& remarks) {
  for (const Remark& remark : remarks)
    if (remark.kind == WheelRemark::time_unit_assumed || remark.kind == truth::TrackRemark::time_unit_assumed)
      return remark.values.at(0);
  return "";
}

/// Combines wheels and truth. If the wheels turn the robot in the direction opposite to the truth, one of
/// four things is wrong, and the motion alone cannot show which: the up axis is reversed, left and right
/// wheel are exchanged, both encoders are reversed (they count backward then), or the recording is a mirror image. Trackers have their origin on the floor, so a
/// body clearly below the origin shows that the axis is reversed. Otherwise nothing is guessed, because with
/// exchanged wheels the right wheel would get the left factor. If both turn alike but the body is below the
/// origin, two of the three may be wrong and hide each other, so the axis must be given.
PairedDrive pair_up(const std::string& name, const DriveFiles& files, ImportedWheels wheels,
                    const ImportedTruth& truth, const RobotGeometry& given, const ImportChoices& choices) {
  const AssumedTimeUnit wheel_times{files.wheels.string(), assumed_in(wheels.track.remarks)},
      truth_times{files.truth.string(), assumed_in(truth.track.facts.remarks)};
  const std::optional<double> counter_range = wheels.track.counter_range;
  WheelRun made = run_of_wheels(name, std::move(wheels), given);
  PairedDrive drive{
      std::move(made.run), {{}, std::move(made.summary), std::move(made.remarks)}, counter_range};
  drive.run.info.truth_source = "file";
  drive.run.info.truth_clock = "tracker";
  std::vector<Remark>& all = drive.report.remarks;
  truth::FloorPath floor = truth::place_on_floor(truth.track, motion_of(drive.run.odometry), choices.floor);
  const bool converted = floor.findings.length_factor != 1;
  for (const Remark& remark : truth.track.facts.remarks)
    if (!converted || remark.kind != Kind(truth::TrackRemark::length_unit_assumed)) all.push_back(remark);
  drive.run.truth = std::move(floor.samples);
  drive.report.floor = std::move(floor.findings);
  all.insert(all.end(), drive.report.floor.remarks.begin(), drive.report.floor.remarks.end());
  require_turning_wheels(name, drive.run, drive.report.floor);
  require_times_alike(drive.run, wheel_times, truth_times);
  settle_direction(name, drive.run, choices.wheels.exchanged, drive.report.floor, all);
  drive.report.summary += summary_of(truth, drive.report.floor);
  return drive;
}

/// Wheels that were worked out from a robot's odometry fit it perfectly.
void refuse_own_odometry(const DriveFiles& files, const std::string& topic, const ImportedTruth& truth) {
  const std::string& id = truth.track.id;
  if (topic.empty() || files.wheels != files.truth || (id != topic && !id.starts_with(topic + ' '))) return;
  throw Error(files.wheels.string() +
                  ": both the wheels and the ground truth would be the robot's own odometry " + topic,
              ImportProblem::odometry_is_truth, {topic});
}

/// Errors of pairing name both files.
PairedDrive paired(const std::string& name, const DriveFiles& files, const ImportChoices& choices,
                   Geometry& geometry) {
  ImportedWheels wheels = read_wheels(files.wheels, choices.wheels);
  const RobotGeometry& sizes = geometry.of(files.wheels, wheels);
  const ImportedTruth truth = read_truth(files.truth, choices.truth);
  refuse_own_odometry(files, wheels.track.odometry, truth);
  try {
    return pair_up(name, files, std::move(wheels), truth, sizes, choices);
  } catch (const Error& error) {
    throw Error(error.in("'" + files.wheels.string() + "' with '" + files.truth.string() + "': "));
  }
}

/// Reads all drives. What one of them does not show is taken from the others.
class AllDrives {
 public:
  AllDrives(std::span<const DriveFiles> files, const ImportChoices& choices)
      : files_(files),
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
    drives_[i] = paired(names_[i], files_[i], choices_[i], geometry_);
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

  std::span<const DriveFiles> files_;
  std::vector<ImportChoices> choices_;  // of each drive
  Geometry geometry_;
  std::vector<std::string> names_;
  std::vector<std::optional<PairedDrive>> drives_ = std::vector<std::optional<PairedDrive>>(files_.size());
  std::vector<std::optional<Error>> failed_ = std::vector<std::optional<Error>>(files_.size());
};

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
  AllDrives reader(files, choices);
  std::vector<PairedDrive> drives = reader.read();
  const std::vector<std::string>& names = reader.names();
  // Wheels that are exchanged and reversed turn the robot as the truth does. Nothing but their direction shows it.
  const bool backward =
      std::all_of(drives.begin(), drives.end(), [](const auto& drive) { return drove_backward(drive.run); });
  if (backward && !choices.drives_backward && !files.empty())
    throw Error("by its wheels the robot drove backward in " +
                    (files.size() == 1 ? "'" + names.front() + "'" : "all drives"),
                ImportProblem::drives_backward, {names.front()});
  ImportedDrives all;
  all.set.names = names;
  for (std::size_t i = 0; i < files.size(); ++i) {
    refuse_copy(drives[i].run, all.set.runs, names[i], names);
    all.set.runs.push_back(std::move(drives[i].run));
    all.reports.push_back(std::move(drives[i].report));
  }
  return all;
}

}  // namespace astro::importing
