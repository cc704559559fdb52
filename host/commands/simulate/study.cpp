#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "host/base/byte_source.hpp"
#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/simulate/commands.hpp"
#include "host/commands/simulate/study_options.hpp"
#include "host/commands/simulate/study_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/simulation/study/kinematic_source.hpp"
#include "host/simulation/study/shard_file.hpp"
#include "host/simulation/study/simulated_source.hpp"
#include "host/simulation/study/study.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

const simulation::study::DriveSource& robot_of(simulation::study::Model model) {
  static const simulation::study::KinematicSource kinematic;
  static const simulation::SimulatedSource simulated;
  if (model == simulation::study::Model::simulator) return simulated;
  return kinematic;
}

struct StudyOptions {
  simulation::study::TrialSetup setup;
  double sigma_theta_deg = 0.15, windup_mrad = 0;
  std::string model = "kinematic", clock = "known", noise = "estimated";
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  simulation::study::Shard shard;
  std::string shard_text = "1/1";
  fs::path out;
  bool json = false;
};

struct MergeOptions {
  std::vector<fs::path> files;
  bool json = false;
};

std::optional<simulation::study::Shard> shard_named(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto number = integer_in(std::string_view(text).substr(0, slash));
  const auto of = integer_in(std::string_view(text).substr(std::min(slash + 1, text.size())));
  if (!number || !of || *number < 1 || *of < *number) return std::nullopt;
  return simulation::study::Shard{*number, *of};
}

void add_tyres(console::Command command, StudyOptions& options) {
  simulation::study::TrialSetup& setup = options.setup;
  add_ranged(command, "--true-e,--e", setup.e,
             "true curvature effect of the tyres: gentle arcs turn about the\n"
             "wheelbase times 1 + e, spins about it",
             "RATIO", -0.2, 0.2, "");
  add_count(command, "--circles", setup.circles, 0, 1000,
            "circles of two turns in each direction, which show e");
  add_size(command, "--radius", setup.circle_radius_m, "of the circles, m");
  add_ranged(command, "--windup", options.windup_mrad,
             "what the tyres hold back of a spin until the next line, mrad; then\n"
             "the squares have a stand of 1 s after each spin and a line of\n"
             "0.3 m at the end. Not of the simulator",
             "MRAD", 0, 100, "mrad");
}

void add_setup(console::Command command, StudyOptions& options) {
  simulation::study::TrialSetup& setup = options.setup;
  command
      .add_option("--model", options.model,
                  "who drives. kinematic: wheels and noise alone;\n"
                  "simulator: the firmware on the simulated robot")
      .one_of({"kinematic", "simulator"})
      .capture_default_str();
  add_count(command, "--trials", setup.trials, 2, 10'000'000,
            "how often it is all repeated; one alone says nothing about chance");
  command.add_option("--seed", setup.seed, "of all noise")
      .type_name("N")
      .capture_default_str()
      .check(console::whole(0, std::numeric_limits<std::uint64_t>::max()));
  add_count(command, "--runs", setup.runs, 1, 1000, "squares in each direction");
  add_size(command, "--side", setup.side_m, "side of the square, m");
  add_ranged(command, "--wheelbase", setup.wheelbase_m, "wheelbase parameter of the robot, m", "M", 0.05, 2,
             "m");
  add_ratio(command, "--true-ed", setup.E_d, "true ratio of the wheel diameters, right over left");
  add_ratio(command, "--true-eb", setup.E_b, "true over nominal wheelbase, both at equal scale");
  add_ratio(command, "--scale", setup.scale, "common to the true wheels and wheelbase");
  add_tyres(command, options);
  add_noise(command, setup.noise, options.sigma_theta_deg, setup.truth_rate_hz);
  add_rate(command, "--count-rate", setup.count_rate_hz, "of the encoder counts, Hz; the simulator's is 100");
  command
      .add_option("--clock", options.clock,
                  "known, or estimated: then each run gets an offset,\n"
                  "which ml has to find")
      .one_of({"known", "estimated"})
      .capture_default_str();
  add_ranged(command, "--clock-sd", setup.clock_offset_sd_s, "of the offsets of an estimated clock, s", "S",
             0, 1, "s");
  command.add_option("--noise", options.noise, "whether ml gets the true noise or estimates it")
      .one_of({"known", "estimated"})
      .capture_default_str();
}

void add_work(console::Command command, StudyOptions& options) {
  add_count(command, "--jobs", options.jobs, 1, 4096, "threads; the result does not depend on them");
  command.add_option("--shard", options.shard_text, "only part I of N, for 'study merge'; needs --out")
      .type_name("I/N")
      .check([](const std::string& text) {
        return shard_named(text) ? "" : "'" + text + "' is no shard: give 1/4 for the first of four";
      });
  command.add_option("--out", options.out, "write the trials here").type_name("FILE");
  add_json_flag(command, options.json);
}

void print_summary(const simulation::study::TrialSetup& setup,
                   const std::vector<simulation::study::Trial>& trials, bool as_json) {
  const simulation::study::Summary summary = summarize(setup, robot_of(setup.model), trials);
  as_json ? print_json(study_json(summary)) : write(study_text(summary));
}

std::vector<simulation::study::Trial> drive(const StudyOptions& options) {
  console::Progress progress("study");
  return run_study(
      options.setup, robot_of(options.setup.model), options.shard, options.jobs, [&](int done, int total) {
        console::check_interrupt();
        progress.show(static_cast<double>(done) / total, fmt::format("trial {} of {}", done, total));
      });
}

void run(StudyOptions& options) {
  options.setup.noise.sigma_theta_rad = radians(options.sigma_theta_deg);
  options.setup.windup_rad = options.windup_mrad / 1000;
  options.setup.model = *simulation::study::model_named(options.model);
  options.setup.clock_known = options.clock == "known";
  options.setup.noise_known = options.noise == "known";
  options.shard = *shard_named(options.shard_text);
  const bool part = options.shard.of > 1;
  if (part && options.out.empty())
    throw console::WrongUsage("--shard makes a part for 'study merge': say with --out where to put it");
  if (part && options.json)
    throw console::WrongUsage("--shard prints no result: give --json to 'study merge'");
  std::optional<PartFile> file;
  if (!options.out.empty()) {  // a file that cannot be written is an error before the work
    require_own_kind(options.out, "\"methods\":", "part of a study");
    file.emplace(options.out);
  }
  const std::vector<simulation::study::Trial> trials = drive(options);
  if (file) {
    const std::string text = to_text(options.setup, trials);
    file->write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    file->commit();
    console::say(fmt::format("trials {} to {} of {} are in '{}'", trials.front().index, trials.back().index,
                             options.setup.trials, options.out.string()));
  }
  if (!part) print_summary(options.setup, trials, options.json);
}

simulation::study::ShardFile load(const fs::path& path) {
  constexpr std::uint64_t kBeginning = 4096;
  FileSource file(path);
  const auto beginning = as_text(file.read(0, static_cast<std::size_t>(std::min(file.size(), kBeginning))));
  // A zero byte shows that the file is no text, so its beginning suffices for the error.
  if (beginning.find('\0') != beginning.npos)
    return simulation::study::read_shard_file(std::string(beginning), path.string());
  // Reads the whole file, because JSON may be one line.
  return simulation::study::read_shard_file(std::string(as_text(load_text(path, kMaxFileBytes))),
                                            path.string());
}

void add_merge(console::Command study) {
  const auto options = std::make_shared<MergeOptions>();
  const console::Command command = study.add_subcommand("merge", "put the shards of one study together");
  command.add_option("FILES", options->files, "what 'study --shard I/N --out FILE' wrote, all N").required();
  add_json_flag(command, options->json);
  console::examples(command,
                    {"astrolabe study merge part-*.json", "astrolabe study merge part-*.json --json"});
  command.callback([options] {
    std::vector<simulation::study::ShardFile> parts;
    for (const fs::path& path : options->files) parts.push_back(load(path));
    const std::vector<simulation::study::Trial> trials = merge(parts);
    print_summary(parts.front().setup, trials, options->json);
  });
}

constexpr Advice kStudyAdvice[] = {
    {simulation::study::StudyProblem::not_a_shard, ": give what 'astrolabe study --out' wrote"},
    {simulation::study::StudyProblem::shard_of_other_version, ": run its shard of 'astrolabe study' again"},
    {simulation::study::StudyProblem::shard_damaged, ": run its shard of 'astrolabe study' again"},
};

}  // namespace

void add_study(console::Command app) {
  advise(kStudyAdvice);
  const auto options = std::make_shared<StudyOptions>();
  const console::Command command = app.add_subcommand(
      "study", "Monte Carlo: how well each calibration method does, beside the Cramer-Rao bound");
  command.require_subcommand(0, 1);
  add_setup(command, *options);
  add_work(command, *options);
  command.footer(
      "A trial drives squares with noise and lets every method calibrate from them.\n"
      "Circles count for ml alone.\n"
      "E_max, theta and the 10 m line are the noise-free errors that remain with the\n"
      "result loaded.\n"
      "Examples:\n"
      "  astrolabe study --trials 500\n"
      "  astrolabe study --clock estimated --side 1.5 --json\n"
      "  astrolabe study --true-e 0.02 --runs 3 --circles 3\n"
      "  astrolabe study --model simulator --trials 100\n"
      "GNU parallel over machines, then the table:\n"
      "  parallel -S host1,host2 --return part-{}.json astrolabe study --trials 10000 \\\n"
      "    --shard {}/16 --jobs 1 --out part-{}.json ::: {1..16}\n"
      "  astrolabe study merge part-*.json\n"
      "A job array (Slurm): sbatch --array=1-100 study.sh, with study.sh saying\n"
      "  astrolabe study --trials 100000 --shard $SLURM_ARRAY_TASK_ID/100 \\\n"
      "    --jobs $SLURM_CPUS_PER_TASK --out part-$SLURM_ARRAY_TASK_ID.json");
  add_merge(command);
  command.callback([command, options] {
    if (!command.has_subcommand()) run(*options);
  });
}

}  // namespace astro::commands
