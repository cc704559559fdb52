#include "host/page/calls/remedies.hpp"

#include "host/calibration/judgement/remarks.hpp"
#include "host/formats/tables/stated_columns.hpp"
#include "host/import/drives/unused_choice.hpp"
#include "host/import/scans/carmen_log.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/import/wheels/wheel_csv.hpp"
#include "host/lidar/scan_calibration.hpp"
#include "host/page/calls/statements.hpp"
#include "host/truth/files/track_problem.hpp"

namespace astro::page {
namespace {

using importing::Choice;
using importing::CounterProblem;
using importing::ImportProblem;
using importing::StatementProblem;
using importing::WheelProblem;
using importing::WheelTableProblem;
using tables::StatedColumnsProblem;
using truth::TrackProblem;

struct Remedy {
  Kind kind;
  std::vector<Choice> choices;
};

std::vector<std::string> names_of(const std::vector<Choice>& choices) {
  std::vector<std::string> names;
  for (const Choice choice : choices) names.emplace_back(importing::name_of(choice));
  return names;
}

}  // namespace

std::vector<std::string> remedies(const Error& error) {
  using enum Choice;
  static const std::vector<Remedy> all{
      {ImportProblem::sizes_not_described, {wheel_diameter, robot}},
      {ImportProblem::no_wheel_diameter, {wheel_diameter, robot}},
      {ImportProblem::no_wheelbase, {wheelbase, robot}},
      {ImportProblem::no_counts_per_turn, {counts_per_turn, robot}},
      {ImportProblem::turns_too_far, {wheel_columns, per_interval, wheels_unit}},
      {ImportProblem::leaps, {wheel_columns, per_interval, counter_range}},
      {ImportProblem::below_origin, {swap_wheels, up}},
      {ImportProblem::turns_against_wheels, {swap_wheels, up}},
      {ImportProblem::turns_against_stated_up, {up, swap_wheels}},
      {ImportProblem::turns_against_exchanged, {swap_wheels, up}},
      {ImportProblem::encoders_reversed, {reverse_wheels, swap_wheels, up}},
      {ImportProblem::drives_backward, {swap_wheels, reverse_wheels, drives_backward}},
      {ImportProblem::per_interval_likely, {per_interval}},
      {ImportProblem::time_unit_doubtful, {wheel_columns, truth_columns}},
      {ImportProblem::odometry_of_commands, {wheels_topic}},
      {ImportProblem::odometry_is_truth, {truth_topic, wheels_topic}},
      {WheelProblem::columns_unclear, {wheel_columns}},
      {WheelProblem::joints_unclear, {joints}},
      {WheelProblem::topic_unclear, {wheels_topic}},
      {WheelProblem::fields_unclear, {wheels_topic}},
      {WheelProblem::unit_unclear, {wheels_unit}},
      {WheelProblem::odometry_needs_sizes, {wheelbase, robot}},
      {WheelProblem::poses_unclear, {truth_topic, truth_frames}},
      {WheelProblem::controller_unclear, {controller}},
      {WheelTableProblem::time_unit_unknown, {wheel_columns}},
      {CounterProblem::range_unknown, {counter_range}},
      {CounterProblem::starts_again, {counter_range}},
      {CounterProblem::too_fast, {counter_range}},
      {CounterProblem::beyond_range, {counter_range}},
      {StatedColumnsProblem::no_such_name, {wheel_columns, truth_columns}},
      {StatedColumnsProblem::no_meaning, {wheel_columns, truth_columns}},
      {StatedColumnsProblem::too_many, {wheel_columns, truth_columns}},
      {TrackProblem::no_columns, {truth_columns}},
      {TrackProblem::no_header, {truth_columns}},
      {TrackProblem::time_unit_unknown, {truth_columns}},
      {truth::FloorProblem::no_up_axis, {up}},
      {truth::BodyProblem::unknown, {body}},
      {StatementProblem::unknown_axis, {up}},
      {StatementProblem::unknown_unit, {wheels_unit}},
      {StatementProblem::joints_not_paired, {joints}},
      {StatementProblem::frames_not_two, {truth_frames}},
      {lidar::ScanProblem::mirrored, {truth_mirrored, swap_wheels}},
      {lidar::ScanProblem::not_mirrored, {truth_mirrored, swap_wheels}},
      {calibration::JudgementProblem::slips_too_much, {swap_wheels}}};
  if (const auto* unused = dynamic_cast<const importing::UnusedChoice*>(&error))
    return {std::string(importing::name_of(unused->choice()))};
  if (error.kind() == importing::ScanFileProblem::topic_unclear) return {kScanTopic};
  for (const Remedy& remedy : all)
    if (remedy.kind == error.kind()) return names_of(remedy.choices);
  return {};
}

}  // namespace astro::page
