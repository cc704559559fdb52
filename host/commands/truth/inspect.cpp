#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "host/base/text/columns.hpp"
#include "host/base/text/degrees.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/shared/import_options.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/shared/unused_choices.hpp"
#include "host/commands/truth/commands.hpp"
#include "host/commands/truth/next_command.hpp"
#include "host/console/console.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/import/drives/inspection_json.hpp"
#include "host/import/scans/bag_scans.hpp"
#include "host/import/scans/carmen_log.hpp"
#include "host/import/wheels/unclear_choice.hpp"

namespace astro::commands {
namespace {

using importing::BagInspection;
using importing::FileInspection;
using importing::RobotGeometry;
using importing::WheelInspection;
using Rows = std::vector<std::vector<std::string>>;

std::string said(const std::vector<Remark>& remarks) {
  std::string text;
  for (const Remark& remark : remarks) text += wrapped(in_words(remark));
  return text;
}

/// If both positions and rotations show the upward direction, the positions decide.
const std::optional<truth::Direction3>& up_of(const truth::BodyInspection& body) {
  return body.up.by_positions ? body.up.by_positions : body.up.by_rotations;
}

std::string noise_text(const std::optional<truth::RestNoise>& noise) {
  if (!noise) return "no rest";
  std::string text = fmt::format("{:.2f} {:.2f} {:.2f} mm", 1000 * noise->sd_m[0], 1000 * noise->sd_m[1],
                                 1000 * noise->sd_m[2]);
  if (noise->sd_rad > 0) text += fmt::format(", {:.3f}°", degrees(noise->sd_rad));
  return text;
}

std::string tracker_text(const truth::Inspection& tracker) {
  std::string text;
  const truth::TrackFacts* facts = tracker.bodies.empty() ? nullptr : &tracker.bodies.front().facts;
  if (facts != nullptr) {
    text += fmt::format("{}: {} bod{}", facts->format, tracker.bodies.size() + tracker.bodies_left_out,
                        tracker.bodies.size() + tracker.bodies_left_out == 1 ? "y" : "ies");
    text += facts->length_unit.empty() ? ", no unit of length stated (taken for metres)"
                                       : ", lengths in " + facts->length_unit;
    if (facts->rotation_kind == truth::RotationKind::none)
      text += ", no orientation";
    else if (!facts->rotation.empty())
      text += ", " + facts->rotation;
    if (facts->rate_hz > 0) text += fmt::format(", {:.6g} Hz stated", facts->rate_hz);
    if (!facts->start_time.empty()) text += ", started " + facts->start_time;
    text = wrapped(text + '.');
  }
  const auto has_two = [](const truth::BodyInspection& body) { return body.samples == 2; };
  if (!tracker.bodies.empty() && std::ranges::all_of(tracker.bodies, has_two)) {
    text += wrapped("Two poses each: where a drive began and where it ended.");
    return text + said(tracker.bodies.front().facts.remarks);
  }
  Rows rows{{"body", "samples", "seconds", "Hz", "lost", "gaps", "longest s", "up", "noise at rest"}};
  for (const truth::BodyInspection& body : tracker.bodies)
    rows.push_back({(body.name.name.empty() ? "(no name)" : body.name.name) +
                        (body.name.id.empty() ? "" : " (" + body.name.id + ")"),
                    fmt::format("{}", body.samples), fmt::format("{:.1f}", body.duration_s),
                    body.median_period_s > 0 ? fmt::format("{:.4g}", 1 / body.median_period_s) : "-",
                    fmt::format("{}", body.lost.all()), fmt::format("{}", body.gaps),
                    fmt::format("{:.2f}", body.longest_gap_s),
                    up_of(body) && !body.facts.flat ? truth::axis_text(*up_of(body)) : "-",
                    noise_text(body.noise)});
  text += console::table(rows);
  if (tracker.bodies_left_out > 0) text += fmt::format("and {} more bodies\n", tracker.bodies_left_out);
  for (const truth::BodyInspection& body : tracker.bodies) text += said(body.facts.remarks);
  return text;
}

std::string source_text(const importing::WheelSource& source) {
  switch (source.kind) {
    case importing::WheelSource::Kind::joints:
      return source.name() + " (joints)";
    case importing::WheelSource::Kind::odometry:
      return source.name() + " (the robot's odometry, turned back with --wheelbase)";
    case importing::WheelSource::Kind::fields:
      break;
  }
  return fmt::format("{} ({})", source.name(),
                     source.measure ? source.measure->name : "unit not known, name it with --wheels-unit");
}

/// What 'calibrate' takes from a bag, and what else it could take.
std::string sources_text(const BagInspection& bag) {
  if (bag.run) return "";
  if (bag.sources.empty()) return '\n' + wrapped("There is nothing of the wheels in it that is recognised.");
  std::string others;
  bool any_joints = false;
  for (const importing::WheelSource& source : bag.sources) {
    if (bag.source && source.name() == bag.source->name()) continue;
    any_joints = any_joints || source.kind == importing::WheelSource::Kind::joints;
    others += (others.empty() ? "" : "; ") + source_text(source);
  }
  std::string text = bag.source ? "'calibrate' takes the wheels from " + source_text(*bag.source) + '.'
                                : "Which of it are the wheels is not clear.";
  if (others.empty()) return '\n' + wrapped(text);
  text += bag.source ? " Others, with --wheels-topic" : " Name them with --wheels-topic";
  text += any_joints && !bag.wheels ? " and --joints: " : ": ";
  return '\n' + wrapped(text + others + '.');
}

std::string bag_text(const BagInspection& bag) {
  std::string text = fmt::format("ROS {} bag of {} file{}.\n", bag.ros1 ? 1 : 2, bag.report.files.size(),
                                 bag.report.files.size() == 1 ? "" : "s");
  if (bag.run)
    text = fmt::format("Recording of astrolabe: {}{}.\n", bag.run->kind,
                       bag.run->robot_name.empty() ? "" : " of " + bag.run->robot_name);
  Rows rows{{"topic", "type", "messages", "seconds", "Hz", "longest gap s"}};
  for (const importing::TopicInspection& one : bag.topics)
    rows.push_back({one.topic.name, one.topic.type, fmt::format("{}", one.topic.messages),
                    fmt::format("{:.1f}", 1e-9 * static_cast<double>(one.topic.last_ns - one.topic.first_ns)),
                    fmt::format("{:.4g}", one.rate_hz), fmt::format("{:.2f}", one.longest_gap_s)});
  text += console::table(rows, "llrrrr");
  if (!bag.poses.empty()) {
    Rows poses{{"poses", "frame", "child frame", "number"}};
    for (const importing::PoseStream& stream : bag.poses)
      poses.push_back({stream.topic, stream.frame, stream.child_frame.empty() ? "-" : stream.child_frame,
                       fmt::format("{}", stream.poses)});
    text += '\n' + console::table(poses, "lllr");
  }
  if (!bag.joints.empty()) {
    std::string joints;
    for (const std::string& joint : bag.joints) joints += (joints.empty() ? "" : ", ") + joint;
    text +=
        '\n' +
        wrapped("Joints: " + joints +
                (bag.wheels ? "; wheels: " + bag.wheels->left + " (left), " + bag.wheels->right + " (right)."
                            : "; which are the wheels, the names do not tell."));
  }
  if (const std::vector<std::string> scans = importing::scan_topics(bag.report.topics); !scans.empty())
    text += '\n' + wrapped("Scans of a laser scanner: " + importing::listed(scans) + '.');
  text += sources_text(bag);
  for (const Remark& warning : bag.report.warnings) text += wrapped(in_words(warning));
  return text;
}

std::string wheels_text(const WheelInspection& wheels) {
  const char* unit = unit_name(wheels.track.unit);
  Rows rows{{"samples", "seconds", "Hz", "longest gap s", std::string("left ") + unit,
             std::string("right ") + unit}};
  rows.push_back({fmt::format("{}", wheels.track.samples.size()), fmt::format("{:.1f}", wheels.duration_s),
                  fmt::format("{:.4g}", wheels.rate_hz), fmt::format("{:.2f}", wheels.longest_gap_s),
                  fmt::format("{:.10g}", wheels.left), fmt::format("{:.10g}", wheels.right)});
  const importing::ReadColumns& columns = wheels.track.columns;
  return wrapped("Wheels of a robot: time from " + columns.time + ", left from " +
                 importing::listed(columns.left) + ", right from " + importing::listed(columns.right) +
                 ", in " + columns.values + ". Travel from the first to the last row:") +
         console::table(rows, "rrrrrr") + said(wheels.track.remarks) +
         (wheels.end_as_they_begin
              ? wrapped("Both wheels end where they began: if each row is the travel since the row "
                        "before, say so with --per-interval.")
              : "");
}

std::string shown(const std::optional<double>& value) { return value ? fmt::format("{:.9g}", *value) : "-"; }

std::string robot_text(const RobotGeometry& robot) {
  Rows rows{{"sizes of a robot", ""},
            {"wheel diameter, m", shown(robot.wheel_diameter_m)},
            {"counts per turn", shown(robot.counts_per_turn)},
            {"wheelbase, m", shown(robot.wheelbase_m)},
            {"c_R", fmt::format("{:.9g}", robot.c_r)},
            {"c_L", fmt::format("{:.9g}", robot.c_l)}};
  if (robot.e != 0) rows.push_back({"e", fmt::format("{:.9g}", robot.e)});
  if (!robot.joints.left.empty()) rows.push_back({"joints", robot.joints.left + ", " + robot.joints.right});
  return console::table(rows);
}

std::string end_poses_text(const calibration::EndPoseTable& table) {
  const calibration::ClusterSummary all = calibration::summarize(table.poses);
  Rows rows{{"runs", "mean x m", "mean y m", "rms x m", "rms y m", "headings"}};
  const auto headings = std::ranges::count_if(
      table.poses, [](const calibration::EndPose& pose) { return std::isfinite(pose.theta_rad); });
  rows.push_back({fmt::format("{}", all.runs), fmt::format("{:.4f}", all.x_cg_m),
                  fmt::format("{:.4f}", all.y_cg_m), fmt::format("{:.4f}", all.rms_x_m),
                  fmt::format("{:.4f}", all.rms_y_m), fmt::format("{}", headings)});
  return "End-pose errors of closed runs:\n" + console::table(rows, "rrrrrr");
}

/// The wheelbase matters to neither the count nor the way.
std::string log_text(const std::filesystem::path& path) {
  const importing::CarmenLog log = importing::read_carmen_log(path, 1);
  std::string text = wrapped(
      fmt::format("Log of CARMEN: {} scans and {} lines of odometry, {:.0f} m and {:.0f} turns; {}.",
                  log.scans, log.odometry, log.way_m, log.turned_rad / (2 * std::numbers::pi),
                  log.corrected ? "a mapping program has corrected its poses" : "its poses are odometry"));
  if (log.damaged > 0) text += fmt::format("{} lines are damaged.\n", log.damaged);
  return text;
}

/// What is in a file, as text of at most 120 columns.
std::string inspection_text(const FileInspection& found) {
  if (found.bag) return bag_text(*found.bag);
  if (found.end_poses) return end_poses_text(*found.end_poses);
  if (found.robot) return robot_text(*found.robot);
  return (found.tracker ? tracker_text(*found.tracker) : "") +
         (found.wheels ? wheels_text(*found.wheels) : "");
}

}  // namespace

void add_inspect(console::Command app) {
  struct Options {
    std::filesystem::path file;
    ImportOptions choices;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  const console::Command command =
      app.add_subcommand("inspect", "say what is in a file of a tracker, a robot or a ROS bag");
  command.add_option("file", options->file, "the file, or the folder of a bag").required();
  add_table_choices(command, options->choices);
  command
      .add_option("--truth-topic", options->choices.truth_topic,
                  "bags: look at the poses of this topic: lost, gaps,\nup axis, noise at rest")
      .type_name("TOPIC");
  add_json_flag(command, options->json);
  command.footer(
      "Recognised by content: Motive CSV, Vicon CSV, TUM, EuRoC, CSV with names and units (also packed with\n"
      "gzip); bags (.bag, .mcap, .db3, folders); logs of CARMEN; tables of wheels. By the end of its name: "
      "sizes of a robot "
      "(.toml, .yaml).\n"
      "Examples:\n"
      "  astrolabe inspect take.csv\n"
      "  astrolabe inspect drive.mcap --truth-topic /tracker/pose\n"
      "  astrolabe inspect ticks.csv --wheel-columns time_s,left_counts,right_counts --per-interval --json");
  command.callback([options] {
    ImportOptions& choices = options->choices;
    choices.wheels = choices.truth = {options->file};
    refuse_unused_choices(choices);
    if (std::filesystem::is_regular_file(options->file) && importing::is_carmen_log(options->file)) {
      const std::string next = command_for_log(options->file);
      if (options->json)
        print_json(nlohmann::json{{"kind", "carmen"}, {"command", next}});
      else
        write(log_text(options->file) + "\nTo calibrate with it (capitals: what it does not show):\n  " +
              next + '\n');
      return;
    }
    const importing::FileInspection found =
        importing::inspect_file(options->file, choices.table,
                                {.columns = choices.truth_columns, .poses = {choices.truth_topic, "", ""}});
    if (!found.wheels && (choices.table.per_interval || !choices.table.columns.empty()))
      throw console::WrongUsage(
          "--wheel-columns and --per-interval do not apply here: this is no table of wheels");
    if (options->json) {
      nlohmann::json json = importing::inspection_json(found);
      json["command"] = next_command(options->file, found, choices);
      print_json(json);
    } else {
      const std::string next = next_command(options->file, found, choices);
      write(inspection_text(found) +
            (next.empty() ? ""
                          : "\nTo calibrate with it (capitals: what it does not show):\n  " + next + '\n'));
    }
  });
}

}  // namespace astro::commands
