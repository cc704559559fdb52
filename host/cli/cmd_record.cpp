#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "host/base/error.hpp"
#include "host/cli/command.hpp"
#include "host/cli/connection.hpp"
#include "host/cli/console.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/truth_option.hpp"
#include "host/experiment/journal.hpp"
#include "host/experiment/record_run.hpp"
#include "host/link/parameters.hpp"
#include "host/recording/csv_export.hpp"
#include "host/recording/run_file.hpp"

namespace astro::cli {
namespace {

struct RecordOptions {
  ConnectionOptions connection;
  TruthOption truth{"none", {}};
  std::filesystem::path out;
  std::filesystem::path csv;
  double seconds = 0;
};

recording::RunInfo describe(link::Client& client) {
  const protocol::HelloReply& robot = client.robot();
  recording::RunInfo info;
  info.kind = "free";
  info.robot_name = robot.robot_name.view();
  for (const std::uint8_t byte : robot.unique_id) info.robot_id += fmt::format("{:02x}", byte);
  info.board = robot.board.view();
  info.firmware = fmt::format("{}.{}.{}", robot.fw_major, robot.fw_minor, robot.fw_patch);
  info.started_at = experiment::utc_now();
  const link::RemoteParameters parameters = link::RemoteParameters::fetch(client);
  for (const link::ParameterRow& row : parameters.rows())
    if (row.kind != protocol::ParameterKind::text)
      info.parameters[row.name] = link::to_real(row, row.active.raw);
  return info;
}

void run(RecordOptions& options) {
  if (options.seconds < 0) throw Error("--seconds must not be negative");
  const auto client = connect(options.connection);
  const auto truth = open_truth(options.truth, options.connection.port);
  const recording::RunInfo info = describe(*client);
  Progress progress("recording");
  const link::microseconds start = client->now();
  const auto done = [&] {
    const double elapsed_s = static_cast<double>((client->now() - start).count()) * 1e-6;
    progress.show(options.seconds > 0 ? elapsed_s / options.seconds : 0, fmt::format("{:.0f} s", elapsed_s));
    return interrupted() || (options.seconds > 0 && elapsed_s >= options.seconds);
  };
  if (options.seconds == 0) say("recording; Ctrl-C ends it");
  const recording::Run run = experiment::record_until(*client, *truth, info, done);
  progress.clear();
  recording::write_run(options.out, run);
  if (!options.csv.empty()) recording::export_csv(run, options.csv);
  say(fmt::format("{} odometry and {} truth samples", run.odometry.size(), run.truth.size()));
  std::cout << std::filesystem::absolute(options.out).string() << '\n';
}

}  // namespace

void add_record(Command app) {
  const auto options = std::make_shared<RecordOptions>();
  const Command command =
      app.add_subcommand("record", "record odometry and ground truth while somebody else drives");
  command.add_option("--out", options->out, "the MCAP file to write").required();
  add_connection(command, options->connection);
  command.add_option("--truth", options->truth.source, "sim or none")
      .one_of({"sim", "none"})
      .capture_default_str();
  command.add_option("--seconds", options->seconds, "end after this time (default: at Ctrl-C)");
  command.add_option("--csv", options->csv, "also write odometry.csv and truth.csv into this folder");
  command.footer(
      "The file opens in Foxglove, PlotJuggler and 'ros2 bag'.\n"
      "Examples:\n"
      "  astrolabe record --out drive.mcap\n"
      "  astrolabe record --port /dev/ttyACM0 --seconds 30 --out drive.mcap --csv drive");
  command.callback([options] { run(*options); });
}

}  // namespace astro::cli
