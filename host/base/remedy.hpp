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
  // files
  name_file,
  name_file_in_it,
  name_other_file,
  name_right_file,
  name_target_of_link,
  check_path,
  check_permissions_and_disk,
  check_disk_or_use_other_folder,
  use_other_folder,
  use_part_file_or_record_again,
  remove_or_name_other_file,
  wait_or_name_other_file,
  wait_or_name_other_folder,
  split_into_shorter_runs,
  split_into_files,
  save_as_csv,
  fill_each_cell,
  log_running_counts,
  separate_by_commas,
  build_image,
  build_image_again,
  // the port and the robot
  find_robots,
  name_port,
  join_serial_group,
  set_runtime_folder,
  start_simulator,
  check_simulator_runs,
  check_link,
  check_robot_is_on,
  check_robot_and_baud,
  check_line,
  connect_first_robot,
  update_program,
  update_firmware,
  update_both,
  end_program,
  end_some_programs,
  start_again,
  await_or_end_program,
  await_or_kill_program,  // {process id}
  list_parameters,
  confirm_values,  // {assignments}
  upload_again,
  upload_again_when_it_answers,
  clear_faults,
  stop_other_program,
  // motors and wires
  check_wiring,
  check_wiring_or_raise_voltage,
  give_more_room,
  measure_with_more_voltage,
  lower_observer_bandwidth,
  set_observer_bandwidth,  // {rad/s}
  check_leads,
  exchange_motor_leads,
  exchange_encoder_plugs,
  check_motor_supply,
  check_encoder_supply,
  check_encoder_wires,
  look_again,
  roll_again,
  roll_straight,
  roll_straight_with_equal_encoders,
  roll_ten_turns,
  count_turns,
  // recordings
  record_runs,
  name_recording,
  name_folder_of_runs,
  drive_squares,
  drive_both_directions,
  drive_some_squares,
  drive_lines_and_turns,
  drive_turns,
  drive_lines,
  record_again,
  record_edited_again,
  copy_or_record_again,
  use_original,
  leave_out_or_record_again,
  leave_out_or_drive_more,
  leave_run_out,   // {run}
  leave_copy_out,  // {run}
  leave_out_if_accident,
  leave_run_out_or_use_end_poses,  // {run}
  name_run_to_leave_out,
  keep_some_runs,
  cut_recording,
  stand_still,
  check_tracker,
  check_recorded_together,
  negate_headings,
  export_orientation_or_check_wiring,
  export_orientation_or_mount_off_axis,
  check_run_and_wiring,
  settle_clock,
  use_simulated_robot,
  write_decimal_point,
  sort_rows,
  // recordings of trackers
  name_body,
  export_with_header,
  export_rigid_bodies,
  export_as_table,
  export_in_one_frame,
  unpack_first,
  // films
  install_film_reader,
  name_film,
  name_film_of_runs,
  resume_with_film,
  take_original_film,
  film_uncut,
  film_mirrored_not,
  film_one_robot,
  film_robot_tag,
  name_robot_tag,  // {id}
  film_floor_tags,
  film_more_floor_tags,
  lay_floor_tags_flat,
  film_nearer,
  film_sharper,
  film_whole_field,
  film_obliquely,
  film_to_the_end,
  film_from_fixed_camera,
  measure_distance,
  measure_figure_again,
  correct_tape,  // {ids}
  give_tag_height,
  // recordings of other programs
  name_wheel_columns,
  name_wheel_joints,
  name_wheel_topic,
  name_pose_stream,
  name_controller,
  check_wheel_units,
  cut_recording_or_check_wheel_units,
  exchange_wheels_or_give_up,
  exchange_wheels_or_change_up,
  say_axis_in_address,  // {axis}
  look_on_other_computers,
  give_wheel_diameter,
  give_counts_per_turn,
  give_wheelbase,
  // calibrations
  name_calibration,
  name_calibration_in_folder,  // {file}
  correct_or_replace_file,
  give_wheel_separation,
  give_wheel_radius,
  set_separation_of_arcs,  // {wheel_separation_multiplier}
  use_end_poses,
  measure_end_headings,
  measure_again_or_leave_out,
  fill_cell_or_leave_out,
  keep_one_column,
  split_by_direction,
  check_units,
  check_units_and_directions,
  check_units_and_wheels,
  estimate_noise,
  look_for_odd_run,
  calibrate_again,
  calibrate_each_phase,
  calibrate_each_robot,
  check_each_phase,
  separate_sizes,
  check_units_or_override,
  load_old_values_or_override,
  calibrate_again_or_override,
  calibrate_robot_or_override,
  override_advice,
  // experiments
  name_experiment,
  choose_other_out_folder,
  give_same_settings_or_choose_other_out_folder,
  load_factors_or_choose_other_out_folder,
  resume_experiment,    // {folder}
  look_at_runs,         // {folder}
  put_back_and_resume,  // {folder}
  resume_for_truth,
  use_same_version,
  drive_run_again,  // {file}
  calibrate_recordings,
  count_runs,
  count_runs_or_change_truth,  // {source}
  keep_order,
  check_wall,
  face_wall_and_resume,
  read_calibration_of_wall,  // {file}
  load_later,                // {file}
  drop_precision_or_method,  // {method}
  // simulations
  stop_simulator_or_choose_other_path,
  choose_other_path,
  choose_shorter_path,
  name_shard,
  name_all_shards,
  name_shard_once,
  run_shard_again,
  merge_one_study,
  run_or_name_shard,
  make_fewer_shards,
  use_own_robot,
  keep_count_rate_or_use_kinematic,
  take_fewer_runs,
  drive_longer_runs,
  drive_longer_runs_or_ask_less,
  give_other_sizes,
  give_runs,
  add_turns,
  add_lines,
  drive_two_circles,
  // viewers
  allow_origin,  // {origin}
  choose_other_tcp_port,
  // the terminal
  answer_at_terminal,
  answer_in_lines,
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
