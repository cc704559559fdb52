#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "host/base/blocked_signals.hpp"
#include "host/base/environment.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/base/served_robot_options.hpp"
#include "host/commands/simulate/commands.hpp"
#include "host/console/console.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/cdr/names.hpp"
#include "host/formats/cdr/type_hash.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/nodes.hpp"
#include "host/live/dds/discovery.hpp"
#include "host/live/dds/fast_dds.hpp"
#include "host/live/dds/participant.hpp"
#include "host/simulation/room/room_file.hpp"
#include "host/simulation/server/virtual_tracker.hpp"

namespace astro::commands {

namespace {

/// The node /virtual_tracker, which publishes each frame as a PoseStamped in the frame "world", reliably. header.stamp is the
/// tracker's clock.
class RosPosePublisher : public simulation::FrameSink {
 public:
  /// `topic`: its full name. Throws astro::Error if the network does not allow it.
  RosPosePublisher(const std::string& topic, const dds::Discovery& discovery);

  void send(const simulation::TrackedFrame& frame) override;

 private:
  std::unique_ptr<dds::Participant> participant_;  // before its writers, so that it outlives them
  std::unique_ptr<dds::Writer> nodes_, poses_;
};

namespace msg = ros2::msg;

constexpr std::int64_t kNanosPerMicro = 1000;
constexpr dds::Qos kReliable{true, false, 10}, kLatched{true, true, 1};

RosPosePublisher::RosPosePublisher(const std::string& topic, const dds::Discovery& discovery) {
  using Info = msg::ParticipantEntitiesInfo<msg::kGidBytes>;
  const BlockedSignals blocked;
  participant_ = dds::open_fast_dds(discovery, "virtual_tracker", "enclave=/;");
  nodes_ = participant_->create_writer({"ros_discovery_info", ros2::dds_type_name(Info::kType), kLatched});
  poses_ = participant_->create_writer({ros2::wire_name_of_topic(topic),
                                        ros2::dds_type_name(msg::PoseStamped::kType), kReliable,
                                        "typehash=" + ros2::hash_of<msg::PoseStamped>() + ";"});
  nodes_->write(ros2::encode(
      Info{{participant_->guid().bytes}, {{{"/"}, {"virtual_tracker"}, {}, {{poses_->guid().bytes}}}}}));
}

void RosPosePublisher::send(const simulation::TrackedFrame& frame) {
  const truth::Pose3& p = frame.pose;
  poses_->write(ros2::encode(msg::PoseStamped{{msg::to_time(kNanosPerMicro * frame.exposed_us), "world"},
                                              {{p.x_m, p.y_m, p.z_m}, {p.qx, p.qy, p.qz, p.qw}}}));
}

struct Options : SimOptions {
  std::string ros_topic;       // "": not in ROS 2
  std::filesystem::path room;  // "": no room, and no scanner
};

void publish_in_ros2(Options& options) {
  if (options.server.fast)
    throw console::WrongUsage(
        "with --fast virtual time runs ahead of the clocks that a tracker's clients go by: leave it out, or "
        "--ros2-topic");
  dds::DiscoveryWishes wishes;
  if (options.server.tracker.everywhere) wishes.range = dds::Range::subnet;
  const dds::Discovery discovery = dds::discovery_from(wishes, environment_variable);
  options.server.tracker.also = std::make_shared<RosPosePublisher>(options.ros_topic, discovery);
  console::say(fmt::format("its pose is at ros2:{}?domain={}", options.ros_topic, discovery.domain));
}

void furnish(Options& options) {
  if (options.server.fast)
    throw console::WrongUsage(
        "with --fast virtual time runs ahead of the clock that stamps scans: leave it out, or --room");
  options.server.room = simulation::read_room(options.room);
}

void run(const Options& wanted) {
  Options options = wanted;
  if (!options.room.empty()) furnish(options);
  prepare(options, simulation::flash_bytes());
  if (!options.ros_topic.empty()) publish_in_ros2(options);
  simulation::Server server(options.robot, options.mocap, options.server);
  serve(server, "a simulated robot");
}

}  // namespace

void add_sim(console::Command app) {
  const auto options = std::make_shared<Options>();
  const console::Command command = app.add_subcommand(
      "sim", "run a simulated robot behind a pseudo terminal, with virtual cameras beside it");
  add_sim_options(command, *options);
  command
      .add_option_function(
          "--wall",
          [options](const std::vector<std::string>& words) {
            options->robot.wall_ahead_m = number_in(words.front());
          },
          "a straight wall across its way, so many m before its front")
      .type_name("M")
      .check(console::between(0, 100, "m"));
  command
      .add_option("--ros2-topic", options->ros_topic,
                  "the same in ROS 2, as geometry_msgs/PoseStamped on this topic")
      .type_name("TOPIC")
      .check([](const std::string& topic) {
        return ros2::is_full_name(topic) ? ""
                                         : "'" + topic + "' is not the full name of a topic, as /ASTRO/pose";
      });
  command
      .add_option(
          "--room", options->room,
          "walls and people around it, as TOML, and with them a laser scanner on it (RPLIDAR A1) at the path "
          "of --pty with .lidar added")
      .type_name("FILE");
  console::examples(
      command, {"astrolabe sim", "astrolabe sim --pty /tmp/astro --fast",
                "astrolabe sim --ros2-topic /ASTRO/pose", "astrolabe sim --pty /tmp/astro --room flat.toml",
                "astrolabe sim --true-ed 1 --true-wheelbase 0.29 --slip 0 --flash astro.flash"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
