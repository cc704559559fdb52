#include "host/commands/shared/import_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "host/commands/base/advice.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/commands/shared/option_words.hpp"
#include "host/commands/shared/unused_choices.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/files/folder_sessions.hpp"
#include "host/formats/tables/stated_columns.hpp"
#include "host/import/drives/robot_geometry.hpp"
#include "host/import/drives/unused_choice.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/travel_measure.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/track_problem.hpp"
#include "host/truth/floor/floor_path.hpp"

namespace astro::commands {
namespace {

console::Check is_axis() {
  return [](const std::string& word) -> std::string {
    return importing::axis_named(word)
               ? ""
               : "'" + word + "' is no axis: give x, y, z, -x, -y, -z or three numbers as 0,1,0";
  };
}

console::Check within(const importing::Limits& limits, const char* unit) {
  return console::between(limits.least, limits.most, unit);
}

constexpr Advice kImportAdvice[] = {
    {importing::ImportProblem::sizes_not_described, ": give --wheel-diameter, or a file with --robot"},
    {importing::ImportProblem::no_wheel_diameter, ": give --wheel-diameter, or a file with --robot"},
    {importing::ImportProblem::no_wheelbase, ": give --wheelbase, or a file with --robot"},
    {importing::ImportProblem::no_counts_per_turn, ": give --counts-per-turn, or a file with --robot"},
    {importing::ImportProblem::turns_too_far,
     ": check the unit of the wheels, and whether their rows are travel --per-interval"},
    {importing::ImportProblem::leaps,
     "; cut the recording there, or check the unit of the wheels and whether their rows are travel "
     "--per-interval; a counter that starts again at its end needs --counter-range"},
    {importing::ImportProblem::below_origin,
     ": give --swap-wheels if left and right are exchanged, or --up with the axis of the tracker that points "
     "up"},
    {importing::ImportProblem::turns_against_wheels,
     ": give --swap-wheels if left and right are exchanged, or --up with the axis of the tracker that points "
     "up"},
    {importing::ImportProblem::encoders_reversed,
     ": give --reverse-wheels; or, if the robot did drive backward, --swap-wheels if left and right are "
     "exchanged, or --up with the axis of the tracker that points up"},
    {importing::ImportProblem::drives_backward,
     ": if it drove forward, give --swap-wheels and --reverse-wheels, or the other of the two if one is "
     "given; if it did drive backward, give --drives-backward"},
    {importing::ImportProblem::per_interval_likely, ": give --per-interval"},
    {importing::ImportProblem::turns_against_stated_up,
     ": give --swap-wheels if left and right are exchanged, or another axis to --up"},
    {importing::ImportProblem::turns_against_exchanged,
     ": leave out --swap-wheels if left and right are not exchanged, or give --up with the axis of the "
     "tracker that points up"},
    {importing::WheelProblem::columns_unclear,
     ": say what they are with --wheel-columns, such as time_s,left_counts,right_counts (also ..._rad, "
     "..._m, "
     "..._rad_s, ..._rpm, ..._m_s; - for one that is not used)"},
    {importing::WheelTableProblem::time_unit_unknown, ": say it with --wheel-columns"},
    {importing::WheelTableProblem::times_fall,
     ": cut the table there if its clock started again, or sort the rows if they are out of order"},
    {truth::TrackProblem::time_not_increasing,
     ": cut the table there if its clock started again, or sort the rows if they are out of order"},
    {importing::ImportProblem::time_unit_doubtful,
     ": say the unit with --wheel-columns or --truth-columns (time_s, time_ms, time_us, time_cs for "
     "hundredths of a "
     "second); numbers of frames are no times, so write seconds instead"},
    {importing::ImportProblem::no_poses, ": name a recording of the whole drive"},
    {importing::WheelTableProblem::times_too_coarse, ": write the times with more digits"},
    {truth::TrackProblem::times_too_coarse, ": write the times with more digits"},
    {importing::CounterProblem::range_unknown, ": give the range with --counter-range"},
    {importing::CounterProblem::starts_again,
     ": if a counter starts again there at the end of its range, give it with --counter-range, otherwise cut "
     "the recording there"},
    {importing::CounterProblem::too_fast,
     ": log more often, or give another --counter-range if that is not its range"},
    {importing::CounterProblem::beyond_range, ": give another --counter-range"},
    {tables::StatedColumnsProblem::no_such_name, ": name columns that it has, or all of them in their order"},
    {truth::TrackProblem::no_columns, ": say what they are with --truth-columns"},
    {truth::TrackProblem::no_header,
     "; or say what they are with --truth-columns, such as time_s,x_m,y_m,theta_rad"},
    {truth::TrackProblem::time_unit_unknown, ": say it with --truth-columns"},
    {importing::WheelProblem::joints_unclear,
     ": name the wheels with --joints LEFT,RIGHT (four wheels: LEFT+LEFT,RIGHT+RIGHT)"},
    {importing::WheelProblem::topic_unclear, ": name one with --wheels-topic"},
    {importing::WheelProblem::fields_unclear,
     ": name both with --wheels-topic TOPIC:LEFT,RIGHT, or with TOPIC,TOPIC if each wheel has its own"},
    {importing::WheelProblem::unit_unclear, ": name one of them with --wheels-unit"},
    {importing::WheelProblem::odometry_needs_sizes, ": give --wheelbase, or a file with --robot"},
    {importing::ImportProblem::odometry_of_commands, ": name others with --wheels-topic"},
    {importing::ImportProblem::odometry_is_truth,
     ": name the tracker's poses with --truth-topic, or other wheels with --wheels-topic"},
    {importing::WheelProblem::poses_unclear,
     ": name one with --truth-topic, and its frames with --truth-frames PARENT,CHILD"},
    {importing::WheelProblem::imu_unclear, ": name one with --imu-topic"},
    {importing::ChoiceRemark::several_imus, "; name one with --imu-topic"},
    {importing::ChoiceRemark::yaw_axis_unclear, "; --imu-axis names the axis that points up"},
    {importing::WheelProblem::controller_unclear, ": name one with --controller"},
    {truth::FloorRemark::units_differ,
     ": check the units, or say that of the ground truth with --truth-unit"},
    {truth::FloorProblem::no_up_axis, "; or give the axis that points up with --up"},
    {truth::BodyProblem::unknown, ": name one of them with --body"},
};

}  // namespace

void add_drive_files(console::Command command, ImportOptions& options) {
  command
      .add_option(
          "--wheels", options.wheels,
          "a drive's wheels: CSV, bag of ROS 1 or 2, or our own\nrecording (repeatable, with --truth)")
      .type_name("FILE")
      .one_each_time();
  command
      .add_option("--truth", options.truth,
                  "its ground truth: Motive, Vicon, Qualisys, TUM or a\ntable (also .gz), a bag, or "
                  "film:FILE, a phone "
                  "film\nof printed tags, one for all drives or one for each")
      .type_name("FILE")
      .one_each_time();
}

void add_table_choices(console::Command command, ImportOptions& options) {
  importing::WheelTable& table = options.table;
  command
      .add_option(
          "--wheel-columns", table.columns,
          "what a table's columns are: all in their order, as\ntime_s,left_counts,right_counts (also _rad, "
          "_m,\n"
          "_rad_s, _rpm, _m_s), or some by their names, as\nstamp=time_ms,encA=left_counts,encB=right_counts")
      .type_name("NAMES");
  command.add_flag("--per-interval", table.per_interval, "each row is the travel since the row before");
  command
      .add_option(
          "--counter-range", table.counter_range,
          "how many counts a counter has before it starts\nagain, as 65536 (default: found from the data)")
      .type_name("COUNTS")
      .check(within(importing::kCounterRangeLimits, "counts"));
  command
      .add_option(
          "--truth-columns", options.truth_columns,
          "the same for ground truth: time_s,x_m,y_m, and\ntheta_rad, or roll_rad,pitch_rad,yaw_rad, or "
          "qx,qy,\nqz,qw")
      .type_name("NAMES");
}

void add_bag_choices(console::Command command, ImportOptions& options) {
  command
      .add_option("--wheels-topic", options.wheels_topic,
                  "bags: the wheels: TOPIC (joints, odometry, or fields\nwith telling names), "
                  "TOPIC:LEFT,RIGHT with both\n"
                  "fields, or TOPIC,TOPIC with a topic for each wheel")
      .type_name("TOPIC");
  std::vector<std::string> units;
  for (const importing::TravelMeasure& measure : importing::travel_measures())
    units.emplace_back(measure.name);
  command.add_option("--wheels-unit", options.wheels_unit, "bags: the unit of such fields and topics")
      .one_of(units);
  command
      .add_option(
          "--joints", options.joints,
          "bags: the joints of the wheels; several on a side as\nLEFT+LEFT,RIGHT+RIGHT, whose mean counts")
      .type_name("LEFT,RIGHT")
      .delimiter(',');
  command
      .add_option("--imu-topic", options.imu_topic,
                  "bags: the topic of the IMU whose gyro is calibrated\nbeside the wheels")
      .type_name("TOPIC");
  command
      .add_option("--imu-axis", options.imu_axis,
                  "bags: which axis of the IMU points up: x, y, z, -x,\n-y, -z or A,B,C (default: found from "
                  "the wheels)")
      .type_name("AXIS")
      .check(is_axis());
}

void add_bag_truth_choices(console::Command command, ImportOptions& options) {
  command.add_option("--truth-topic", options.truth_topic, "bags: the topic of the tracker's poses")
      .type_name("TOPIC");
  command.add_option("--truth-frames", options.frames, "bags: the frames of a transform")
      .type_name("PARENT,CHILD")
      .delimiter(',');
}

void add_body_choice(console::Command command, ImportOptions& options) {
  command.add_option("--body", options.body, "trackers: the body, by name or number").type_name("NAME");
}

void add_tracker_choices(console::Command command, ImportOptions& options) {
  command.add_option("--up", options.up, "the tracker's axis that points up: x, y, z, -x, -y,\n-z or A,B,C")
      .type_name("AXIS")
      .check(is_axis());
  command.add_option("--truth-unit", options.unit, "the unit of its positions, in place of the file's")
      .one_of({std::begin(importing::kTruthUnits), std::end(importing::kTruthUnits)});
  command.add_option("--truth-mirrored", options.mirrored, "its positions are a mirror image")
      .one_of({"auto", "yes", "no"})
      .capture_default_str();
}

void add_geometry_choices(console::Command command, ImportOptions& options) {
  advise(kImportAdvice);
  command
      .add_option(
          "--robot", options.robot_file,
          "sizes of the robot: a file of 'params export', a\ncalib.toml that it carries, or parameters of\n"
          "diff_drive_controller (YAML)")
      .type_name("FILE");
  command.add_option("--controller", options.controller, "the controller in a YAML file with several")
      .type_name("NAME");
  command.add_option("--wheel-diameter", options.wheel_diameter_m, "nominal, m")
      .check(within(importing::kWheelDiameterLimits_m, "m"));
  command.add_option("--counts-per-turn", options.counts_per_turn, "encoder counts in a turn of the wheel")
      .check(within(importing::kCountsPerTurnLimits, "counts"));
  command.add_option("--wheelbase", options.wheelbase_m, "as the robot's odometry takes it, m")
      .check(within(importing::kWheelbaseLimits_m, "m"));
  command.add_flag("--swap-wheels", options.swap_wheels, "left and right are exchanged in the files");
  command.add_flag("--reverse-wheels", options.reverse_wheels,
                   "both encoders count backward when the robot drives\nforward");
  command.add_flag("--drives-backward", options.drives_backward, "the robot did drive backward");
}

void add_session_flag(console::Command command, bool& session_per_folder) {
  command.add_flag("--session-per-folder", session_per_folder,
                   "drives share the place of the tracked body and the\n"
                   "rate of the clocks within a folder, and only there\n"
                   "(default: as the drives themselves show)");
}

void add_import(console::Command command, ImportOptions& options) {
  add_drive_files(command, options);
  add_table_choices(command, options);
  add_bag_choices(command, options);
  add_bag_truth_choices(command, options);
  add_body_choice(command, options);
  add_tracker_choices(command, options);
  add_geometry_choices(command, options);
  add_film_options(command, options.film_figures, "film: ");
  add_session_flag(command, options.session_per_folder);
}

importing::ImportChoices choices_of(const ImportOptions& options) {
  return stated([&] { return importing::choices_of(options); });
}

std::vector<std::filesystem::path> ImportOptions::films() const {
  std::vector<std::filesystem::path> found;
  for (const std::filesystem::path& one : truth)
    if (const auto film = film_named(one.string());
        film && std::find(found.begin(), found.end(), *film) == found.end())
      found.push_back(*film);
  return found;
}

void give_films(experiment::RunSet& set, const ImportOptions& options) {
  const std::vector<std::filesystem::path> films = options.films();
  require_film_for(options.film_figures, !films.empty());
  if (!films.empty()) give_truth(set, follow_films(films, options.film_figures), options.film_figures);
}

namespace {

/// What holds for several drives is said once, behind what holds for each.
void say_drives(const importing::ImportedDrives& drives) {
  std::map<std::string, std::vector<std::string>> said_of;
  for (std::size_t i = 0; i < drives.reports.size(); ++i)
    for (const Remark& remark : drives.reports[i].remarks)
      if (std::vector<std::string>& names = said_of[in_words(remark)];
          names.empty() || names.back() != drives.set.names[i])
        names.push_back(drives.set.names[i]);
  for (std::size_t i = 0; i < drives.reports.size(); ++i) {
    console::say(drives.set.names[i] + ": " + drives.reports[i].summary);
    for (const Remark& remark : drives.reports[i].remarks)
      if (said_of[in_words(remark)].size() == 1) console::say(drives.set.names[i] + ": " + in_words(remark));
  }
  for (const importing::DriveReport& report : drives.reports)
    for (const Remark& remark : report.remarks) {
      std::vector<std::string>& names = said_of[in_words(remark)];
      if (names.size() < 2) continue;
      const bool all = names.size() == drives.reports.size();
      console::say(fmt::format("{}: {}", all ? "all drives" : fmt::format("{}", fmt::join(names, ", ")),
                               in_words(remark)));
      names.clear();
    }
}

/// The wheels of all drives, and films that show them.
experiment::RunSet read_filmed_drives(const ImportOptions& options) {
  const auto is_film = [](const std::filesystem::path& one) { return film_named(one.string()).has_value(); };
  if (!std::all_of(options.truth.begin(), options.truth.end(), is_film))
    throw console::WrongUsage(
        "films and other files of ground truth cannot be mixed: give all --truth as film:FILE, or none");
  if (options.wheels.empty())
    throw console::WrongUsage("a film shows no wheels: give --wheels of each drive as well");
  if (!options.up.empty() || !options.unit.empty() || options.mirrored != "auto" || !options.body.empty())
    throw console::WrongUsage("--up, --truth-unit, --truth-mirrored and --body do not apply to films");
  refuse_unused_choices(options);
  experiment::RunSet set = read_wheel_files(options);
  if (options.session_per_folder) set.sessions = experiment::sessions_by_folder(options.wheels);
  give_films(set, options);
  return set;
}

}  // namespace

experiment::RunSet read_wheel_files(const ImportOptions& options) {
  importing::ImportedDrives drives =
      stated([&] { return importing::import_wheels(options.wheels, importing::choices_of(options)); });
  say_drives(drives);
  return std::move(drives.set);
}

experiment::RunSet read_drive_files(const ImportOptions& options) {
  require_film_for(options.film_figures, !options.films().empty());
  if (!options.films().empty()) return read_filmed_drives(options);
  importing::ImportedDrives drives = stated([&] { return importing::import_stated(options); });
  if (options.session_per_folder)
    drives.set.sessions = experiment::sessions_by_folder(options.wheels, options.truth);
  say_drives(drives);
  return std::move(drives.set);
}

}  // namespace astro::commands
