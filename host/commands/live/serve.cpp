#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/live/commands.hpp"
#include "host/commands/live/foxglove_options.hpp"
#include "host/commands/live/robot_driver.hpp"
#include "host/commands/shared/truth_option.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/live/driver/driver.hpp"
#include "host/live/driver/middleware.hpp"
#include "host/live/driver/names.hpp"
#include "host/live/foxglove/foxglove_server.hpp"
#include "host/recording/sample_messages.hpp"
#include "host/truth/source/source.hpp"

namespace astro::commands {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::seconds kRest{1};  // before a source that has failed is asked again

/// Publishes ground truth as the node's topic `truth` (geometry_msgs/PoseStamped, in the tracker's frame). If a tracker is
/// lost and found again, it reports each once. A pose that the tracker does not see consists of NaNs.
class TruthTopic {
 public:
  using Open = std::function<std::unique_ptr<truth::Source>()>;

  /// `open` opens the source again after it was lost, without waiting; null for a source that comes back by itself.
  /// `middleware` must outlive it.
  TruthTopic(live::Middleware& middleware, const live::Names& names, std::unique_ptr<truth::Source> source,
             Open open)
      : open_(std::move(open)),
        source_(std::move(source)),
        publisher_(
            middleware.advertise({names.absolute("truth"), live::message_type<ros2::msg::PoseStamped>()})) {}

  /// Publishes what has come; never waits. `driver` converts the robot's clock and this computer's to UTC.
  void step(live::Driver& driver) {
    if (steady_clock::now() < ask_at_) return;
    try {
      if (!source_) source_ = open_();
      publish(driver);
    } catch (const Error& error) {
      if (open_) source_.reset();
      if (!std::exchange(lost_, true)) console::say(in_words(error));
      ask_at_ = steady_clock::now() + kRest;
    }
  }

 private:
  void publish(live::Driver& driver) {
    for (recording::TruthSample sample : source_->poll()) {
      if (std::exchange(lost_, false)) console::say("ground truth comes again");
      const auto time_ns = source_->clock() == "robot" ? driver.utc_of_robot_ns(sample.time_us)
                                                       : driver.utc_of_host_ns(sample.time_us);
      if (!time_ns) continue;
      sample.time_us = *time_ns / 1000;
      publisher_->publish(recording::encode_truth(sample), *time_ns);
    }
  }

  Open open_;
  std::unique_ptr<truth::Source> source_;  // null while it is lost
  std::unique_ptr<live::Publisher> publisher_;
  bool lost_ = false;
  steady_clock::time_point ask_at_{};
};

struct ServeOptions {
  RobotDriverOptions driver;
  FoxgloveOptions viewers;
  TruthOption truth{"none", {}, {}};
};

void run(ServeOptions& options) {
  if (!options.viewers.wanted) throw console::WrongUsage("serve what? --foxglove serves viewers");
  take_listen_port(options.driver.connection.port, options.viewers);
  ConnectionOptions& connection = options.driver.connection;
  if (connection.port.empty() && options.truth.source == "sim") connect(connection);  // finds the only robot
  std::unique_ptr<truth::Source> source;
  if (options.truth.source != "none") source = open_truth(options.truth, connection.port);
  TruthTopic::Open open_again;  // none for trackers, which are found again without it
  if (options.truth.source == "sim")
    open_again = [option = options.truth, port = connection.port] { return open_truth(option, port); };
  foxglove::FoxgloveServer server(foxglove_settings(options.viewers, "Astrolabe", names_of(options.driver)));
  std::optional<TruthTopic> truth;
  if (source) truth.emplace(server, names_of(options.driver), std::move(source), open_again);
  console::say(foxglove_announcement(options.viewers, server.port()));
  drive_robot({&server}, options.driver, "astrolabe", [&](live::Driver& driver) {
    if (truth) truth->step(driver);
  });
}

}  // namespace

void add_serve(console::Command app) {
  const auto options = std::make_shared<ServeOptions>();
  const console::Command command =
      app.add_subcommand("serve", "show the robot live in Foxglove: pose, model, wheels, state, parameters");
  add_foxglove_options(command, options->viewers);
  add_robot_driver_options(command, options->driver);
  command
      .add_option("--truth", options->truth.source,
                  "ground truth beside odometry, as truth: sim,\nvrpn://HOST/BODY, natnet://HOST/BODY "
                  "or\nros2:/TOPIC")
      .type_name("SOURCE")
      .check(truth_source({"sim", "none"}));
  console::examples(command, {"astrolabe serve --foxglove", "astrolabe serve --foxglove --port 8766",
                              "astrolabe serve --foxglove --truth sim --rate 200",
                              "astrolabe serve --foxglove --allow-commands --listen 192.168.1.7:8765"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
