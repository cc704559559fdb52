#include "host/page/robot/opened_robot.hpp"

#include <utility>

#include "host/base/error.hpp"
#include "host/simulation/robot/in_process.hpp"

namespace astro::page {
namespace {

/// Until somebody watches more closely: enough to see the robot move.
constexpr protocol::SetTelemetry kTelemetry{20, protocol::Telemetry::kAll};

}  // namespace

OpenedRobot::OpenedRobot(std::string port, live::OpenPort open, live::HostClock clock,
                         std::shared_ptr<simulation::VirtualRobot> simulated)
    : port_(std::move(port)),
      clock_(std::move(clock)),
      simulated_(std::move(simulated)),
      link_(std::move(open), clock_, kTelemetry) {
  if (simulated_) start_ = pose_of(simulated_->board().truth());
  if (!seek()) throw Error(link_.why());
  while (!required_session().read_parameters(std::chrono::seconds(1))) {
  }
}

std::unique_ptr<OpenedRobot> OpenedRobot::at_port(const RobotPorts& ports, const std::string& path) {
  if (!ports.open) throw Error("there are no ports here: open a simulated robot");
  return std::unique_ptr<OpenedRobot>(new OpenedRobot(
      path, [open = ports.open, path] { return open(path); }, ports.clock, nullptr));
}

std::unique_ptr<OpenedRobot> OpenedRobot::simulated(const sim::Config& config) {
  const auto robot =
      std::make_shared<simulation::VirtualRobot>(config, simulation::MocapConfig{.seed = config.seed});
  const auto now = [robot] { return microseconds(static_cast<std::int64_t>(robot->board().world_us())); };
  const live::HostClock clock{now, [now] { return now().count() * 1000; }};
  return std::unique_ptr<OpenedRobot>(new OpenedRobot(
      "", [robot] { return std::make_unique<simulation::InProcessTransport>(robot); }, clock, robot));
}

live::RobotSession& OpenedRobot::required_session() {
  if (live::RobotSession* session = link_.session()) return *session;
  throw Error(link_.why().in("the link to the robot is lost: "));
}

bool OpenedRobot::seek() {
  if (!link_.seek()) return false;
  link_.session()->stop_left_drive();
  return true;
}

void OpenedRobot::lose(const Error& why) {
  if (link_.session() != nullptr) link_.lose(why);
}

std::optional<Pose2> OpenedRobot::truth() const {
  if (!simulated_) return std::nullopt;
  return start_.between(pose_of(simulated_->board().truth()));
}

std::vector<recording::TruthSample> OpenedRobot::take_truth() {
  return simulated_ ? simulated_->take_truth() : std::vector<recording::TruthSample>{};
}

}  // namespace astro::page
