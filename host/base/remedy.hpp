#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace astro {

/// What would help against something that went wrong or looks odd. Libraries name the kind; the commands,
/// which know what their options and subcommands are called, put it into words
/// (host/commands/base/remedies.hpp).
enum class Help : std::uint8_t {
  none,
  // the robot
  find_robots,
  list_parameters,
  clear_faults,
  stop_other_program,
  check_wiring,
  check_wiring_or_raise_voltage,
  give_more_room,
  // recordings
  record_runs,
  drive_squares,
  leave_run_out,   // {run}
  leave_copy_out,  // {run}
  leave_out_if_accident,
  leave_run_out_or_use_end_poses,  // {run}
  use_end_poses,
  check_run_and_wiring,
  settle_clock,
  use_simulated_robot,
  // calibrations
  name_calibration,
  give_wheel_separation,
  give_wheel_radius,
  override_guard,
  // experiments
  name_experiment,
  choose_other_folder,
  give_same_settings_or_choose_other_folder,
  load_factors_or_choose_other_folder,
  resume_experiment,  // {folder}
  calibrate_recordings,
  count_runs,
  count_runs_or_change_truth,  // {source}
  keep_order,
  drop_precision_or_method,  // {method}
  // simulations
  stop_simulator_or_choose_other_path,
  choose_other_path,
  choose_shorter_path,
  name_shard,
  run_shard_again,
  // the terminal
  agree_beforehand,
};

inline constexpr std::size_t kHelps = static_cast<std::size_t>(Help::agree_beforehand) + 1;

/// A kind of help with the value that its sentence names, if it names one.
struct Remedy {
  Help help = Help::none;
  std::string value = {};
};

/// A notice that is not an error: a whole sentence, and what would help.
struct Remark {
  std::string fact;
  Remedy remedy = {};
};

}  // namespace astro
