#include "host/import/drives/unused_choice.hpp"

#include <algorithm>
#include <functional>

#include "host/formats/files/bag.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<fs::path>;

bool is_missing(const fs::path& path) {
  std::error_code ignored;
  return !fs::exists(path, ignored);
}

bool any_bag(const Files& files) {
  return std::ranges::any_of(files,
                             [](const fs::path& path) { return is_missing(path) || bag::is_bag(path); });
}

bool any_text(const Files& files) {
  return std::ranges::any_of(files,
                             [](const fs::path& path) { return is_missing(path) || !bag::is_bag(path); });
}

/// Joints do not apply to a recording of ours, which contains the wheels, unless a topic is named.
bool any_bag_of_others(const StatedDrives& drives) {
  return std::ranges::any_of(drives.wheels, [&](const fs::path& path) {
    return is_missing(path) ||
           (bag::is_bag(path) && (!drives.wheels_topic.empty() || !is_own_recording(path)));
  });
}

bool has_controllers(const fs::path& path) {
  return !path.empty() && (is_missing(path) || is_controller_file(path));
}

struct Statement {
  Choice choice;
  std::string_view name;
  bool given;
  std::function<bool(const StatedDrives&)> applies;
  const char* otherwise;
};

std::vector<Statement> statements_in(const StatedDrives& drives) {
  constexpr const char *kNoTable = "none of the files of wheels is a table",
                       *kNoBagOfWheels = "none of the files of wheels is a bag of another program",
                       *kNoBagOfPoses = "none of the files of ground truth is a bag";
  const auto others = [](const StatedDrives& all) { return any_text(all.wheels) || any_bag_of_others(all); };
  const auto tables = [](const StatedDrives& all) { return any_text(all.wheels); };
  const auto bags_of_wheels = [](const StatedDrives& all) { return any_bag(all.wheels); };
  const auto bags_of_poses = [](const StatedDrives& all) { return any_bag(all.truth); };
  const auto takes = [](const StatedDrives& all) { return any_text(all.truth); };
  const auto controllers = [](const StatedDrives& all) { return has_controllers(all.robot_file); };
  const auto always = [](const StatedDrives&) { return true; };
  return {
      {Choice::wheel_columns, "wheel_columns", !drives.table.columns.empty(), tables, kNoTable},
      {Choice::per_interval, "per_interval", drives.table.per_interval, tables, kNoTable},
      {Choice::counter_range, "counter_range", drives.table.counter_range.has_value(), others,
       "the files of wheels are our own recordings"},
      {Choice::truth_columns, "truth_columns", !drives.truth_columns.empty(), takes,
       "no file of ground truth is a table"},
      {Choice::wheels_topic, "wheels_topic", !drives.wheels_topic.empty(), bags_of_wheels, kNoBagOfWheels},
      {Choice::wheels_unit, "wheels_unit", !drives.wheels_unit.empty(), bags_of_wheels, kNoBagOfWheels},
      {Choice::imu_topic, "imu_topic", !drives.imu_topic.empty(), bags_of_wheels, kNoBagOfWheels},
      {Choice::imu_axis, "imu_axis", !drives.imu_axis.empty(), bags_of_wheels, kNoBagOfWheels},
      {Choice::joints, "joints", !drives.joints.empty(), any_bag_of_others, kNoBagOfWheels},
      {Choice::truth_topic, "truth_topic", !drives.truth_topic.empty(), bags_of_poses, kNoBagOfPoses},
      {Choice::truth_frames, "truth_frames", !drives.frames.empty(), bags_of_poses, kNoBagOfPoses},
      {Choice::body, "body", !drives.body.empty(), takes, "all files of ground truth are bags"},
      {Choice::controller, "controller", !drives.controller.empty(), controllers,
       "no parameters of controllers (YAML) are named for the robot"},
      {Choice::up, "up", !drives.up.empty(), always, ""},
      {Choice::truth_unit, "truth_unit", !drives.unit.empty(), always, ""},
      {Choice::truth_mirrored, "truth_mirrored", drives.mirrored != StatedDrives().mirrored, always, ""},
      {Choice::robot, "robot", !drives.robot_file.empty(), always, ""},
      {Choice::wheel_diameter, "wheel_diameter", drives.wheel_diameter_m.has_value(), always, ""},
      {Choice::counts_per_turn, "counts_per_turn", drives.counts_per_turn.has_value(), always, ""},
      {Choice::wheelbase, "wheelbase", drives.wheelbase_m.has_value(), always, ""},
      {Choice::swap_wheels, "swap_wheels", drives.swap_wheels, always, ""},
      {Choice::reverse_wheels, "reverse_wheels", drives.reverse_wheels, always, ""},
      {Choice::drives_backward, "drives_backward", drives.drives_backward, always, ""}};
}

}  // namespace

std::string_view name_of(Choice choice) {
  static const std::vector<Statement> all = statements_in({});
  return std::ranges::find(all, choice, &Statement::choice)->name;
}

std::vector<Choice> stated_choices(const StatedDrives& drives) {
  std::vector<Choice> given;
  for (const Statement& statement : statements_in(drives))
    if (statement.given) given.push_back(statement.choice);
  return given;
}

void refuse_unused_choices(const StatedDrives& drives) {
  for (const Statement& statement : statements_in(drives))
    if (statement.given && !statement.applies(drives))
      throw UnusedChoice(statement.choice, statement.otherwise);
}

void refuse_choices_unused_with_scans(const StatedDrives& drives) {
  using enum Choice;
  const std::vector<Choice> of_trackers{truth_columns, truth_topic,    truth_frames, body, up,
                                        truth_unit,    drives_backward},
      of_logs{truth_mirrored, robot, controller, wheelbase, swap_wheels, reverse_wheels};
  const bool logs = !any_bag(drives.truth);
  for (const Choice choice : stated_choices(drives)) {
    if (std::ranges::count(of_trackers, choice) > 0) throw UnusedChoice(choice, "the ground truth is scans");
    if (logs && std::ranges::count(of_logs, choice) == 0)
      throw UnusedChoice(choice, "a log of CARMEN has odometry instead of wheels");
  }
  refuse_unused_choices(drives);
}

void refuse_choices_unused_with_arrays(const StatedDrives& drives) {
  using enum Choice;
  const std::vector<Choice> of_files{wheel_columns, per_interval, counter_range, truth_columns, wheels_topic,
                                     wheels_unit,   joints,       truth_topic,   truth_frames,  truth_unit,
                                     body,          imu_topic,    imu_axis};
  for (const Choice choice : stated_choices(drives))
    if (std::ranges::count(of_files, choice) > 0) throw UnusedChoice(choice, "the drives are arrays");
}

}  // namespace astro::importing
