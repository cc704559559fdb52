#include <fmt/format.h>

#include <memory>
#include <optional>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/experiment/commands.hpp"
#include "host/commands/experiment/record_programme.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/drive_recording.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/shared/truth_option.hpp"
#include "host/commands/simulate/programme_options.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/experiment/files/robot_identity.hpp"
#include "host/recording/csv_export.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/recording/run_writer.hpp"
#include "host/robot/parameters/parameters.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct RecordOptions {
  ConnectionOptions connection;
  TruthOption truth{"none", {}, {}};
  fs::path out;
  fs::path csv;
  double seconds = 0;
  simulation::study::Programme programme;
  ProgrammeOptions runs;
  console::Option seconds_option, csv_option, pause_option;
  bool pause = false;
};

/// Checks before the drive that the file can be written, because a drive cannot be repeated.
void require_new(const fs::path& file) {
  if (fs::exists(file) && !fs::is_directory(file))
    throw Error(
        fmt::format("'{}' exists, and a recording replaces nothing: name another file", file.string()));
  const PartFile can_be_written(file);
}

void drive(RecordOptions& options) {
  const std::vector<ProgrammeRun> runs = runs_of(options.programme);
  if (runs.empty())
    throw console::WrongUsage(
        "no runs to drive: say how many squares, lines, spins or circles, or leave them all out");
  if (options.seconds_option.count() + options.csv_option.count() > 0)
    throw console::WrongUsage(
        "--seconds and --csv are for recording what another program drives: leave them out, or the runs");
  if (fs::exists(options.out) && !fs::is_directory(options.out))
    throw Error(
        fmt::format("'{}' is a file, and each run gets one of its own: name a folder", options.out.string()));
  const auto client = connect_to_drive(options.connection);
  const auto truth = open_truth(options.truth, options.connection.port);
  if (options.truth.source == "none")
    console::say("without --truth nothing can be calibrated from these runs");
  recording::RunInfo info = describe_robot(*client);
  info.speed_mps = options.programme.speed_mps;
  record_programme(*client, *truth, runs, info, options.out, options.pause);
  print_path(fs::absolute(options.out));
}

/// A recording that is written while samples arrive, so that a day takes no more memory than a minute. If the
/// robot sends nothing, no file is created.
class StreamedRecording {
 public:
  StreamedRecording(const RecordOptions& options, const recording::RunInfo& info)
      : options_(options), info_(info) {}

  template <class Sample>
  void add(const Sample& sample) {
    open();
    run_->add(sample);
    if constexpr (requires { csv_->add(sample); })  // scans and what the gyro says have no table
      if (csv_) csv_->add(sample);
  }
  void close() {
    open();
    run_->close(info_);
    if (csv_) csv_->close();
  }

 private:
  void open() {
    if (run_) return;
    run_.emplace(options_.out, info_);
    if (!options_.csv.empty()) csv_.emplace(options_.csv);
  }

  const RecordOptions& options_;
  const recording::RunInfo& info_;
  std::optional<recording::RunWriter> run_;
  std::optional<recording::CsvWriter> csv_;
};

/// Time by the robot's clock, because the clocks of a simulator in fast motion and of an emulator on a busy
/// machine differ from ours. A robot that restarts counts from 0 again.
class RobotStopwatch {
 public:
  explicit RobotStopwatch(robot::Client& client)
      : client_(client), last_us_(client.request(protocol::Ping{}).device_time_us) {}

  double seconds() {
    const std::uint64_t now_us = client_.device_time_us();
    elapsed_us_ += now_us < last_us_ ? now_us : now_us - last_us_;
    last_us_ = now_us;
    return static_cast<double>(elapsed_us_) * 1e-6;
  }

 private:
  robot::Client& client_;
  std::uint64_t last_us_, elapsed_us_ = 0;
};

void listen(RecordOptions& options) {
  if (options.pause_option.count() > 0)
    throw console::WrongUsage("--pause waits before runs: say how many to drive");
  require_new(options.out);
  if (!options.csv.empty())
    for (const char* name : {"odometry.csv", "truth.csv"}) require_new(options.csv / name);
  const auto client = connect(options.connection);
  const auto truth = open_truth(options.truth, options.connection.port);
  recording::RunInfo info = describe_robot(*client);
  console::Progress progress("recording");
  RobotStopwatch stopwatch(*client);
  const auto done = [&] {
    const double elapsed_s = stopwatch.seconds();
    const std::string shown = fmt::format("{:.0f} s", elapsed_s);
    if (options.seconds > 0) progress.show(elapsed_s / options.seconds, shown);
    if (options.seconds == 0) progress.show(shown);
    return console::interrupted() || (options.seconds > 0 && elapsed_s >= options.seconds);
  };
  if (options.seconds == 0) console::say("recording; Ctrl-C ends it");
  info.truth_source = truth->name();
  info.truth_clock = truth->clock();
  StreamedRecording streamed(options, info);
  const experiment::Recorded recorded = experiment::record_until(
      *client, *truth,
      {[&](const auto& sample) { streamed.add(sample); }, [&](const auto& sample) { streamed.add(sample); },
       [&](const auto& scan) { streamed.add(scan); }, [&](const auto& slip) { streamed.add(slip); },
       [&](const auto& pose) { streamed.add(pose); }},
      done);
  progress.clear();
  streamed.close();
  console::say(fmt::format("{} odometry and {} truth samples{}", recorded.odometry, recorded.truth,
                           recorded.scans == 0 ? "" : fmt::format(", {} scans", recorded.scans)));
  if (recorded.slips > 0)
    console::say(fmt::format("by its gyro the robot turned {} times without its wheels", recorded.slips));
  if (recorded.warning)
    throw Error(
        fmt::format("{}; what came before is in '{}'", recorded.warning->sentence, options.out.string()),
        recorded.warning->kind, recorded.warning->values);
  print_path(fs::absolute(options.out));
}

constexpr Advice kRecordAdvice[] = {
    {recording::RecordingProblem::none_in_folder,
     ": record some with 'astrolabe record' or 'astrolabe umbmark', or name another folder"},
};

}  // namespace

void add_record(console::Command app) {
  advise(kRecordAdvice);
  const auto options = std::make_shared<RecordOptions>();
  const console::Command command =
      app.add_subcommand("record", "drive runs and record them, or record while another program drives");
  command.add_option("--out", options->out, "the MCAP file to write, or the folder for the runs").required();
  add_connection(command, options->connection);
  command
      .add_option("--truth", options->truth.source,
                  "sim, none, lidar:PORT (an RPLIDAR on the robot),\nor a tracker: vrpn://HOST/BODY, "
                  "natnet://HOST/BODY,\nros2:/TOPIC (poses, or scans of a laser scanner)")
      .type_name("SOURCE")
      .check(truth_source({"sim", "none", "lidar"}))
      .capture_default_str();
  add_mirrored_scans(command, options->truth);
  options->seconds_option = command
                                .add_option("--seconds", options->seconds,
                                            "end after this time on the robot's clock (default: at Ctrl-C)")
                                .type_name("S")
                                .check(console::positive("s"));
  options->csv_option =
      command.add_option("--csv", options->csv, "also write odometry.csv and truth.csv into this folder");
  options->runs = add_programme(command, options->programme);
  options->pause_option = command.add_flag("--pause", options->pause, "wait for Enter before each run");
  command.footer(
      "With numbers of runs it drives them, each from rest to rest and into a file of its own;\n"
      "those that the folder holds already are not driven again. Without, it drives nothing and\n"
      "records what another program at the same port drives.\n"
      "The files open in Foxglove, PlotJuggler and 'ros2 bag'.\n"
      "Examples:\n"
      "  astrolabe record --out drive.mcap\n"
      "  astrolabe record --lines 3 --spins 2 --circles 2 --truth sim --out programme\n"
      "  astrolabe record --port /dev/ttyACM0 --truth ros2:/vrpn_mocap/robot/pose --out drive.mcap\n"
      "  astrolabe record --port /dev/ttyACM0 --truth lidar:/dev/ttyUSB0 --out drive.mcap\n"
      "  astrolabe record --port /dev/ttyACM0 --seconds 30 --out drive.mcap --csv drive");
  command.callback([options] { options->runs.named() ? drive(*options) : listen(*options); });
}

}  // namespace astro::commands
