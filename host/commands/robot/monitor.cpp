#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/robot/commands.hpp"
#include "host/commands/robot/monitor_view.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/keys.hpp"
#include "host/console/options.hpp"
#include "host/console/terminal.hpp"

namespace astro::commands {
namespace {

using protocol::Telemetry;
using std::chrono::milliseconds;

struct MonitorOptions {
  ConnectionOptions connection;
  bool json = false;
  double rate_hz = 10;
  std::uint64_t count = 0;  // 0: no end
};

/// Whoever gave no count ends the command by Ctrl-C; otherwise samples are missing then.
bool ended(const MonitorOptions& options) {
  if (options.count > 0) console::check_interrupt();
  return console::interrupted();
}

/// Telemetry samples in the order of their arrival.
class Stream {
 public:
  Stream(robot::Client& client, double rate_hz)
      : client_(client),
        period_ms_(static_cast<std::uint16_t>(std::lround(1000 / rate_hz))),
        subscription_(
            client.on<Telemetry>([this](const Telemetry& telemetry) { waiting_.push_back(telemetry); })) {
    ask();
  }

  void ask() { client_.request(protocol::SetTelemetry{period_ms_, Telemetry::kAll}); }

  /// The samples since the last call; waits up to 50 ms if there are none.
  std::vector<Telemetry> take() {
    client_.pump_until([&] { return !waiting_.empty() || console::interrupted(); }, milliseconds(50));
    return std::exchange(waiting_, {});
  }

 private:
  robot::Client& client_;
  std::uint16_t period_ms_;
  std::vector<Telemetry> waiting_;
  robot::Subscription subscription_;
};

void print_lines(robot::Client& client, const MonitorOptions& options) {
  Stream stream(client, options.rate_hz);
  for (std::uint64_t printed = 0;;) {
    for (const Telemetry& sample : stream.take()) {
      print(to_json(sample).dump());
      if (++printed == options.count) return;
    }
    if (ended(options)) return;
  }
}

/// The live view.
class Monitor {
 public:
  Monitor(robot::Client& client, const MonitorOptions& options)
      : client_(client),
        options_(options),
        stream_(client, options.rate_hz),
        robot_(fmt::format("{}   {}", client.robot().robot_name.view(), client.name())) {}

  void run() {
    while (!quit_wanted()) {
      if (console::interrupted() && !figures_.lost.empty()) throw Error(figures_.lost);
      if (ended(options_)) return;
      try {
        if (update()) return;
      } catch (const robot::LinkLost& lost) {
        figures_.lost = in_words(lost);
        draw();
        find_again();
      }
    }
  }

 private:
  /// Returns true when enough samples have arrived.
  bool update() {
    for (const Telemetry& sample : stream_.take()) {
      newest_ = sample;
      if (++seen_ == options_.count) return draw(), true;
    }
    if (client_.now() >= measure_at_) measure();
    if (client_.now() >= draw_at_) draw();
    return false;
  }

  void measure() {
    const microseconds sent = client_.now();
    client_.request(protocol::Ping{});
    figures_.round_trip_ms = static_cast<double>((client_.now() - sent).count()) * 1e-3;
    measure_at_ = client_.now() + std::chrono::seconds(1);
  }

  void find_again() {
    try {
      client_.reconnect(milliseconds(500));
      stream_.ask();
      figures_.lost.clear();
    } catch (const robot::LinkLost&) {  // the next turn tries again
    }
  }

  void draw() {
    figures_.drift = client_.clock().drift();
    figures_.counts = client_.counts();
    figures_.frames = client_.frames();
    if (seen_ > 0) picture_.draw(monitor_picture(robot_, newest_, figures_), monitor_line(newest_, figures_));
    draw_at_ = client_.now() + milliseconds(100);
  }

  bool quit_wanted() {
    const std::vector<console::Key> keys = reader_.read(terminal_.typed());
    return std::find(keys.begin(), keys.end(), console::Key::quit) != keys.end();
  }

  robot::Client& client_;
  const MonitorOptions& options_;
  Stream stream_;
  std::string robot_;
  console::RawTerminal terminal_;
  console::KeyReader reader_;
  console::Picture picture_{STDOUT_FILENO};
  LinkFigures figures_;
  Telemetry newest_;
  std::uint64_t seen_ = 0;
  microseconds measure_at_{}, draw_at_{};
};

void run(MonitorOptions& options) {
  const auto client = connect(options.connection);
  if (options.json || !console::stdout_is_terminal()) {
    print_lines(*client, options);
  } else {
    Monitor(*client, options).run();
  }
}

}  // namespace

void add_monitor(console::Command app) {
  const auto options = std::make_shared<MonitorOptions>();
  const console::Command command =
      app.add_subcommand("monitor", "watch the robot live; piped: one line of JSON per sample");
  command.add_option("--rate", options->rate_hz, "samples per second of the robot's clock")
      .type_name("HZ")
      .capture_default_str()
      .check(console::between(1, 200, "Hz"));
  command.add_option("--count", options->count, "end after this many samples")
      .type_name("N")
      .check(console::whole(1, std::uint64_t{1} << 53));
  add_connection(command, options->connection);
  add_json_flag(command, options->json);
  console::examples(command,
                    {"astrolabe monitor", "astrolabe monitor --json --rate 100 --count 1000 > samples.jsonl",
                     "astrolabe monitor --count 1 | jq .battery_V"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
