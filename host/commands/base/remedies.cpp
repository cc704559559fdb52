#include "host/commands/base/remedies.hpp"

#include <fmt/format.h>

#include <iterator>

namespace astro::commands {
namespace {

struct Sentence {
  Help help;
  const char* text;  // with the joint to the fact before it; {} is the remedy's value
};

constexpr Sentence kSentences[] = {
    {Help::none, ""},
    {Help::name_file, ": name a file"},
    {Help::name_file_in_it, ": name a file in it"},
    {Help::name_other_file, ": name another file"},
    {Help::name_right_file, ": name the right file"},
    {Help::name_target_of_link, ": name the file itself"},
    {Help::check_path, ": check the path"},
    {Help::check_permissions_and_disk, ": check its permissions and the disk"},
    {Help::check_disk_or_use_other_folder, "; check the disk or choose another folder"},
    {Help::use_other_folder, ": choose another folder"},
    {Help::use_part_file_or_record_again, "; rename that file to use it, or record the run again"},
    {Help::remove_or_name_other_file, ": remove it or name another file"},
    {Help::wait_or_name_other_file, ": wait for it or name another file"},
    {Help::wait_or_name_other_folder, ": wait for it or name another folder"},
    {Help::split_into_shorter_runs, ": split it into shorter runs"},
    {Help::split_into_files, ": split it into one file for each run"},
    {Help::save_as_csv, ": save the table as comma separated UTF-8"},
    {Help::fill_each_cell, ": give every column a cell, and write numbers with a decimal point"},
    {Help::log_running_counts,
     ": record again, and log the counters themselves, of which a lost row takes nothing away"},
    {Help::separate_by_commas, ": use commas, and decimal points in the numbers"},
    {Help::build_image, ": build one with './dev firmware'"},
    {Help::build_image_again, ": build the image again"},
    {Help::find_robots, ": 'astrolabe ports' lists the robots that are here"},
    {Help::name_port, ": name the port itself"},
    {Help::join_serial_group,
     ": add yourself to its group (sudo usermod -aG dialout $USER), then log in again"},
    {Help::set_runtime_folder, "; set XDG_RUNTIME_DIR to a folder that belongs to you"},
    {Help::start_simulator, ": is the simulator running?"},
    {Help::check_simulator_runs, ": is it still running?"},
    {Help::check_link, ": is the link good?"},
    {Help::check_robot_is_on, ": is the robot still on and connected?"},
    {Help::check_robot_and_baud, ": is it a robot running Astrolabe, switched on and set to this baud rate?"},
    {Help::check_line, ": is the line to the robot connected?"},
    {Help::connect_first_robot, ": connect the first one again"},
    {Help::update_program, ": update this program"},
    {Help::update_firmware, ": update the robot's firmware"},
    {Help::update_both, "; update both"},
    {Help::end_program, ": end that program first"},
    {Help::end_some_programs, ": end some of them"},
    {Help::await_or_end_program, ": let it go on, or end it"},
    {Help::await_or_kill_program, ": let it go on, or end it with 'kill -9 {}'"},
    {Help::list_parameters, ": 'astrolabe params list' shows those it has"},
    {Help::upload_again, ": upload again"},
    {Help::upload_again_when_it_answers, ": upload again once it answers"},
    {Help::clear_faults, "; remove its cause, then run 'astrolabe faults --clear'"},
    {Help::stop_other_program, ": end that one, or 'astrolabe stop' ends its drive"},
    {Help::check_wiring, "; 'astrolabe check-wiring' finds crossed or reversed wires"},
    {Help::check_wiring_or_raise_voltage,
     "; 'astrolabe check-wiring' finds out which, or give it more with --max-voltage"},
    {Help::give_more_room, "; give it more room with --max-distance"},
    {Help::measure_with_more_voltage, ": measure again with more voltage"},
    {Help::lower_observer_bandwidth, ": lower observer_bandwidth"},
    {Help::set_observer_bandwidth, "; an observer_bandwidth of {} rad/s would allow it"},
    {Help::check_leads, ": look at which leads go where, and check again"},
    {Help::exchange_motor_leads, ": exchange the leads of the left and the right motor at the driver"},
    {Help::exchange_encoder_plugs, ": exchange the plugs of the left and the right encoder"},
    {Help::check_motor_supply, ": look at its leads, the driver and its supply"},
    {Help::check_encoder_supply, ": look at its plug, its supply and both channels"},
    {Help::check_encoder_wires, "; look at both wires"},
    {Help::look_again, ": check again and look closely"},
    {Help::roll_again, ": roll again, and check the length"},
    {Help::roll_straight, ": roll the robot straight on, and check the wiring first"},
    {Help::roll_straight_with_equal_encoders,
     ": roll straight on, and look whether both encoders are of one kind"},
    {Help::roll_ten_turns, ": roll the robot ten turns"},
    {Help::count_turns, "; if it is not, roll again and count turns (gear ratio)"},
    {Help::record_runs,
     ": record some with `astrolabe record` or `astrolabe umbmark`, or name another folder"},
    {Help::name_recording, ": name a recording made by astrolabe"},
    {Help::name_folder_of_runs, ": name a folder that holds recorded runs"},
    {Help::drive_squares, ": drive some with 'astrolabe umbmark'"},
    {Help::drive_both_directions, ": drive the square at least once clockwise and once counter-clockwise"},
    {Help::drive_some_squares, ": record at least one, better five"},
    {Help::drive_lines_and_turns, ": drive both ways round, and lines as well as turns"},
    {Help::drive_turns, ": drive squares, circles or spins as well"},
    {Help::drive_lines, ": drive lines or squares as well"},
    {Help::record_again, ": record it again"},
    {Help::record_edited_again, "; record the run again"},
    {Help::copy_or_record_again, ": copy it again from where it was recorded, or record the run again"},
    {Help::use_original, "; use the original"},
    {Help::leave_out_or_record_again, ": leave it out, or record it again"},
    {Help::leave_out_or_drive_more, "; drive at least a metre or a turn, or leave it out"},
    {Help::leave_run_out, ": leave it out (of a folder: 'astrolabe calibrate runs --without {}')"},
    {Help::leave_copy_out, ": leave one out with --without {}"},
    {Help::leave_out_if_accident,
     "; look there, and if it was an accident leave the run out (of a folder: 'astrolabe calibrate runs "
     "--without ...')"},
    {Help::leave_run_out_or_use_end_poses,
     ": leave it out with 'astrolabe calibrate runs --without {}', or use --method robust, extended or "
     "umbmark"},
    {Help::name_run_to_leave_out, ": name the one to leave out"},
    {Help::keep_some_runs, ": keep some to calibrate from"},
    {Help::cut_recording, "; cut it there"},
    {Help::stand_still, ": record a standstill there"},
    {Help::check_tracker, ": check that the tracker sees the robot there"},
    {Help::check_recorded_together, ": check that both were recorded together"},
    {Help::negate_headings, "; negate them"},
    {Help::export_orientation_or_check_wiring,
     ": export the orientation, too, or see what 'astrolabe check-wiring' finds"},
    {Help::export_orientation_or_mount_off_axis,
     ": export the orientation of the body, too, or mount it away from the axis"},
    {Help::check_run_and_wiring,
     ": check that they belong to the same drive, with 'astrolabe check-wiring' that no encoder is "
     "reversed, and in files of other programs whether each row of the wheels is the travel since the row "
     "before (--per-interval)"},
    {Help::settle_clock,
     ": record wheels and ground truth from the rest before the drive to the rest after it, or give the "
     "truth the robot's times and --clock known"},
    {Help::use_simulated_robot, ": --truth sim needs a robot started with 'astrolabe sim'"},
    {Help::write_decimal_point, "; write it with a decimal point"},
    {Help::sort_rows, "; sort the rows, or leave the column out"},
    {Help::name_body, ": name one of them with --body"},
    {Help::export_with_header, ": export the recording again with its header"},
    {Help::export_rigid_bodies,
     ": solve the assets of the take, and export it again with rigid bodies switched on"},
    {Help::export_as_table, ": open the take in a newer version of Motive and export it again"},
    {Help::export_in_one_frame,
     ": export positions and orientations with the same axes, and do not change them afterwards"},
    {Help::unpack_first, ": unpack it with 'gzip -d' first"},
    {Help::install_film_reader, ": install ffmpeg ('apt install ffmpeg'), which has it"},
    {Help::name_film, ": name the film that the phone recorded (MP4 or MOV)"},
    {Help::name_film_of_runs, ": name the film that shows these runs"},
    {Help::resume_with_film, ": the same command with --truth film:FILE goes on with it"},
    {Help::take_original_film,
     ": copy the original file from the phone once more, not one that a messenger or an editor wrote; if "
     "that is "
     "it, film again and end the recording before the phone is moved"},
    {Help::film_uncut, ": film everything in one go, and take the file as the phone wrote it"},
    {Help::film_mirrored_not,
     ": film with the rear camera without a mirror effect, and print the tags as they are, not mirrored"},
    {Help::film_one_robot, ": film with one robot, and one print of its tag, in the picture"},
    {Help::film_robot_tag,
     ": lay the robot's tag flat on top of it, with a white margin all around, and film it from above in "
     "even "
     "light"},
    {Help::name_robot_tag, ": if that is on the robot, give --robot-tag {}"},
    {Help::film_floor_tags,
     ": tape four to six tags flat to the floor around the field, with numbers of their own, and have all of "
     "them "
     "in the picture"},
    {Help::film_more_floor_tags, ": four to six around the field check one another"},
    {Help::lay_floor_tags_flat, ": tape them flat to one level floor, all of one size, and film again"},
    {Help::film_nearer,
     ": film from nearer or more from above, in 1080p or better, or print larger tags: 30 px of height in "
     "the "
     "farthest corner are good"},
    {Help::film_sharper,
     ": clean the lens, lock the focus on the floor, give more light, and film again at the highest quality"},
    {Help::film_whole_field,
     ": choose the place of the phone so that the robot's tag stays in the picture all the time"},
    {Help::film_obliquely,
     ": film from the side, looking down by 35 to 60 degrees, if wheels and wheelbase have to be right by "
     "more"},
    {Help::film_to_the_end,
     ": start the film two seconds before the first drive, and end it two seconds after the last"},
    {Help::film_from_fixed_camera,
     ": put the phone on a shelf or a tripod where nothing touches it, switch stabilisation off, and film "
     "again"},
    {Help::measure_distance,
     "; measure one, best from the centre of one floor tag to that of another three metres away, and give it "
     "with "
     "--tape"},
    {Help::measure_figure_again, ": measure that again, or leave it out"},
    {Help::correct_tape, ": correct --tape {}=..., or leave it out"},
    {Help::give_tag_height, ": measure it and give it with --tag-height"},
    {Help::name_wheel_columns,
     ": describe the columns with --wheel-columns, such as time_s,left_counts,right_counts (also ..._rad, "
     "..._m; "
     "- for one that is not used)"},
    {Help::name_wheel_joints, ": name the wheels with --joints LEFT,RIGHT"},
    {Help::name_wheel_topic, ": name one with --wheels-topic"},
    {Help::name_pose_stream,
     ": name one with --truth-topic, and its frames with --truth-frames PARENT,CHILD"},
    {Help::name_controller, ": name one with --controller"},
    {Help::check_wheel_units,
     ": check the unit of the wheels, and whether their rows are travel --per-interval"},
    {Help::cut_recording_or_check_wheel_units,
     "; cut the recording there, or check the unit of the wheels and whether their rows are travel "
     "--per-interval"},
    {Help::exchange_wheels_or_give_up,
     ": give --swap-wheels if left and right are exchanged, or --up with the axis of the tracker that points "
     "up"},
    {Help::exchange_wheels_or_change_up,
     ": give --swap-wheels if left and right are exchanged, or another axis to --up"},
    {Help::say_axis_in_address, ": if {0} points up, put up={0} behind the ? of the tracker's address"},
    {Help::look_on_other_computers,
     "; only this computer is looked at: for others put range=subnet behind the ? of the tracker's address, "
     "or "
     "set ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET"},
    {Help::give_wheel_diameter, ": give --wheel-diameter, or a file with --robot"},
    {Help::give_counts_per_turn, ": give --counts-per-turn, or a file with --robot"},
    {Help::give_wheelbase, ": give --wheelbase, or a file with --robot"},
    {Help::name_calibration, ": name a file that 'astrolabe calibrate' wrote"},
    {Help::name_calibration_in_folder, ": name a calibration in it, such as '{}'"},
    {Help::correct_or_replace_file, ": correct or replace it"},
    {Help::give_wheel_separation, ": give --wheel-separation"},
    {Help::give_wheel_radius, ": give --wheel-radius"},
    {Help::set_separation_of_arcs,
     "; drive with the odometry of Astrolabe's firmware, which has both, or set wheel_separation_multiplier "
     "to "
     "{} if the robot mostly drives arcs"},
    {Help::use_end_poses, ": choose --method robust, extended or umbmark, which use end poses alone"},
    {Help::measure_end_headings,
     ": measure the end headings (etheta_rad or etheta_deg), or use the method umbmark"},
    {Help::measure_again_or_leave_out, ": measure it again or leave the run out"},
    {Help::fill_cell_or_leave_out, ": write the number or leave the run out"},
    {Help::keep_one_column, ": keep one of them"},
    {Help::split_by_direction, ": split it"},
    {Help::check_units, ": check the units"},
    {Help::check_units_and_directions,
     ": check the units, the side length and that the clockwise and counter-clockwise runs are not "
     "exchanged"},
    {Help::check_units_and_wheels,
     ": check the unit of the ground truth, the wheel diameter and the counts of a turn"},
    {Help::estimate_noise, ": let the noise be estimated (without --K, --sigma-xy and --sigma-theta)"},
    {Help::look_for_odd_run,
     "; look for a run whose chi²/dof is far above the others', for slip, and for truth of another drive"},
    {Help::calibrate_again, "; calibrate again"},
    {Help::calibrate_each_phase, ": calibrate each phase for itself (name its folder)"},
    {Help::calibrate_each_robot, ": calibrate each for itself"},
    {Help::check_each_phase, ": check them separately"},
    {Help::separate_sizes, ": keep each size in a folder of its own"},
    {Help::check_units_or_override, ": check units, side and robot (--force uploads all the same)"},
    {Help::load_old_values_or_override,
     ": load the old values or drive again (--force uploads all the same)"},
    {Help::calibrate_again_or_override, ": calibrate again (--force uploads all the same)"},
    {Help::calibrate_robot_or_override, ": calibrate this one (--force uploads all the same)"},
    {Help::override_advice, ": it is advised against (--force uploads all the same)"},
    {Help::name_experiment, ": name the --out of 'astrolabe umbmark', or two or more folders of recordings"},
    {Help::choose_other_out_folder, ": choose another --out"},
    {Help::give_same_settings_or_choose_other_out_folder,
     ": give the same ones to go on with it, or another --out"},
    {Help::load_factors_or_choose_other_out_folder, ": load those, or choose another --out"},
    {Help::resume_experiment, ": 'astrolabe umbmark --out {}' goes on from there"},
    {Help::look_at_runs,
     "; 'astrolabe calibrate runs {}' shows each run, and the same command drives those again whose "
     "recordings are removed there"},
    {Help::put_back_and_resume,
     ": put it on its start mark; the same command with --out {} drives that run again"},
    {Help::resume_for_truth,
     "; the same command goes on with its ground truth, at a terminal or with all answers piped in"},
    {Help::use_same_version, ": use that one to go on with it"},
    {Help::drive_run_again, " (to drive it again, remove '{}')"},
    {Help::calibrate_recordings,
     ": the recordings beside it can still be calibrated with 'astrolabe calibrate runs'"},
    {Help::count_runs, ": give --runs in place of --until"},
    {Help::count_runs_or_change_truth,
     ": give --runs in place of --until, or another source than --truth {}"},
    {Help::keep_order, ": leave out --order"},
    {Help::check_wall,
     ": see that the wall is straight and firm, the front of the robot flat, and the floor free and clean"},
    {Help::face_wall_and_resume,
     ": put it in front of the wall, facing it, with nothing in its way; the same command goes on"},
    {Help::read_calibration_of_wall, ": what came out of it is in '{}'"},
    {Help::load_later, "; 'astrolabe upload {}' loads it later"},
    {Help::drop_precision_or_method, ": leave out --until or --method {}"},
    {Help::stop_simulator_or_choose_other_path, ": stop it or choose another --pty"},
    {Help::choose_other_path, ": choose another path for --pty"},
    {Help::choose_shorter_path, ": choose a shorter one for --pty"},
    {Help::name_shard, ": give what 'astrolabe study --out' wrote"},
    {Help::name_all_shards, ": name the files of all shards"},
    {Help::name_shard_once, ": name each shard once"},
    {Help::run_shard_again, ": run its shard of 'astrolabe study' again"},
    {Help::merge_one_study, ": merge shards of one study only"},
    {Help::run_or_name_shard, ": run their shard, or name its file, too"},
    {Help::make_fewer_shards, ": make fewer shards or more trials"},
    {Help::use_own_robot, ": give it its own robot"},
    {Help::keep_count_rate_or_use_kinematic,
     ": leave the rate of the counts at that, or take the kinematic model"},
    {Help::take_fewer_runs, ": take fewer or shorter runs, or lower rates"},
    {Help::drive_longer_runs, ": drive longer ones"},
    {Help::drive_longer_runs_or_ask_less, ": drive longer ones, ask for less, or lessen the slip"},
    {Help::give_other_sizes, ": give other sizes"},
    {Help::give_runs, ": say how many squares, lines, spins or circles"},
    {Help::add_turns, ": add squares, spins or circles"},
    {Help::add_lines, ": add squares, lines or circles"},
    {Help::drive_two_circles, ": drive two"},
    {Help::allow_origin, "; --allow-origin '{}' allows it"},
    {Help::choose_other_tcp_port, ": choose another port with --listen"},
    {Help::answer_at_terminal, ": answer at a terminal, or pipe all answers in"},
    {Help::answer_in_lines, ": give one answer in each line"},
    {Help::agree_beforehand, ": give --yes to agree beforehand"},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < std::size(kSentences); ++i)
    if (static_cast<std::size_t>(kSentences[i].help) != i) return false;
  return std::size(kSentences) == kHelps;
}
static_assert(in_order(), "every kind of help has its sentence, in the order of the kinds");

}  // namespace

std::string in_words(const Remedy& remedy) {
  const char* text = kSentences[static_cast<std::size_t>(remedy.help)].text;
  return fmt::format(fmt::runtime(text), remedy.value);
}

std::string in_words(const Error& error) { return error.what() + in_words(error.remedy()); }

std::string in_words(const Remark& remark) { return remark.fact + in_words(remark.remedy); }

}  // namespace astro::commands
