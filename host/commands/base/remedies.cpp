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
    {Help::find_robots, ": 'astrolabe ports' lists the robots that are here"},
    {Help::list_parameters, ": 'astrolabe params list' shows those it has"},
    {Help::clear_faults, "; remove its cause, then run 'astrolabe faults --clear'"},
    {Help::stop_other_program, ": end that one, or 'astrolabe stop' ends its drive"},
    {Help::check_wiring, "; 'astrolabe check-wiring' finds crossed or reversed wires"},
    {Help::check_wiring_or_raise_voltage,
     "; 'astrolabe check-wiring' finds out which, or give it more with --max-voltage"},
    {Help::give_more_room, "; give it more room with --max-distance"},
    {Help::record_runs,
     ": record some with `astrolabe record` or `astrolabe umbmark`, or name another folder"},
    {Help::drive_squares, ": drive some with 'astrolabe umbmark'"},
    {Help::leave_run_out, ": leave it out with 'astrolabe calibrate runs --without {}'"},
    {Help::leave_copy_out, ": leave one out with --without {}"},
    {Help::leave_out_if_accident, "; look there, and leave the run out with --without if it was an accident"},
    {Help::leave_run_out_or_use_end_poses,
     ": leave it out with 'astrolabe calibrate runs --without {}', or use --method extended or umbmark"},
    {Help::use_end_poses, ": choose --method extended or umbmark, which use end poses alone"},
    {Help::check_run_and_wiring,
     ": check that they belong to the same drive, and with 'astrolabe check-wiring' that no encoder "
     "is reversed"},
    {Help::settle_clock,
     ": record wheels and ground truth from the rest before the drive to the rest after it, or give "
     "the truth the robot's times and --clock known"},
    {Help::use_simulated_robot, ": --truth sim needs a robot started with 'astrolabe sim'"},
    {Help::name_calibration, ": name a file that 'astrolabe calibrate' wrote"},
    {Help::give_wheel_separation, ": give --wheel-separation"},
    {Help::give_wheel_radius, ": give --wheel-radius"},
    {Help::override_guard, " (--force uploads all the same)"},
    {Help::name_experiment, ": name the --out of 'astrolabe umbmark', or two or more folders of recordings"},
    {Help::choose_other_folder, ": choose another --out"},
    {Help::give_same_settings_or_choose_other_folder,
     ": give the same ones to go on with it, or another --out"},
    {Help::load_factors_or_choose_other_folder, ": load those, or choose another --out"},
    {Help::resume_experiment, ": 'astrolabe umbmark --out {}' goes on from there"},
    {Help::calibrate_recordings,
     ": the recordings beside it can still be calibrated with 'astrolabe calibrate runs'"},
    {Help::count_runs, ": give --runs in place of --until"},
    {Help::count_runs_or_change_truth,
     ": give --runs in place of --until, or another source than --truth {}"},
    {Help::keep_order, ": leave out --order"},
    {Help::drop_precision_or_method, ": leave out --until or --method {}"},
    {Help::stop_simulator_or_choose_other_path, ": stop it or choose another --pty"},
    {Help::choose_other_path, ": choose another path for --pty"},
    {Help::choose_shorter_path, ": choose a shorter one for --pty"},
    {Help::name_shard, ": give what 'astrolabe study --out' wrote"},
    {Help::run_shard_again, ": run its shard of 'astrolabe study' again"},
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
