#include "host/simulation/server/server.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <thread>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/base/system_error.hpp"
#include "host/simulation/server/virtual_rplidar.hpp"

namespace astro::simulation {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// Limit of the bytes that a host has not taken. Beyond it the robot's own queue fills, and it drops frames.
constexpr std::size_t kMostOutgoing = 1U << 16;
constexpr std::uintmax_t kMostFlashBytes = std::uintmax_t{8} << 20;  // the largest of a Teensy's family
// How far virtual time may run ahead of a host in fast motion: for how long after its last bytes, and how many steps at once.
struct Lead {
  std::uint64_t silence_us;
  int steps;  // of a millisecond, between two looks for bytes
};
constexpr Lead kLead{100'000, 50};
// While the robot drives. A sign of life between two velocities, or bytes of another program or of a relay,
// start the silence anew; even then the robot must not reach its command time-out of 200 ms. More than the 50
// ms after which drivers give a sign of life by the robot's clock.
constexpr Lead kLeadOfDriver{70'000, 15};
// While a host regulates the motors' voltages itself, at least once in 20 ms. Its output must reach the robot
// soon after the measurement. Otherwise its control loop oscillates on a busy machine, as it would with no
// real robot.
constexpr Lead kLeadOfRegulator{30'000, 1};
// In real time: how long a driver may be silent while the robot drives. The shortest command time-out is 200 ms.
constexpr std::uint64_t kSilenceOfDriver_us = 150'000;
// How long time waits for a host that takes no bytes or sends none, in turns of this server, each of at least
// a millisecond. On a busy machine a program may not run for some hundred milliseconds, and a robot that then
// stops by its own time-out surprises its owner. Turns are counted and not seconds, because a machine that
// gives the host no time gives this server little, too. Fast motion waits longer, because it promises nothing
// about real time, and a virtual machine may stop one of its processors for some seconds.
constexpr int kPatience = 1000, kPatienceInFastMotion = 10'000;

const Lead& lead(ServedRobot& robot) {
  if (robot.is_regulated()) return kLeadOfRegulator;
  return robot.drives() ? kLeadOfDriver : kLead;
}

sim::Config with_flash(sim::Config config, const fs::path& path) {
  config.flash = load_flash(path);
  return config;
}

std::uint64_t serial_number_of(const ServerConfig& server) {
  const fs::path& place = server.flash.empty() ? server.pty : server.flash;
  const fs::path folder = fs::weakly_canonical(fs::absolute(place).parent_path());
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  for (const char c : (folder / place.filename()).string())
    hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3;
  return hash;
}

fs::path beside(fs::path pty, const char* suffix) { return pty += suffix; }

ScannerConfig scanner_of(const sim::Config& robot, const RoomFile& file) {
  ScannerConfig scanner;
  scanner.mount = file.scanner_mount;
  scanner.upside_down = file.scanner_upside_down;
  scanner.seed = robot.seed;
  return scanner;
}

class ServedVirtualRobot : public ServedRobot {
 public:
  ServedVirtualRobot(const sim::Config& config, const MocapConfig& mocap) : robot_(config, mocap) {}
  ServedVirtualRobot(const sim::Config& config, const MocapConfig& mocap, const RoomFile& room)
      : robot_(config, mocap, room.room, scanner_of(config, room)),
        rplidar_(std::in_place, RplidarConfig{}, scanner_of(config, room)) {}

  void step() override {
    robot_.step();
    if (rplidar_) rplidar_->measure(robot_.scanner()->beams());
  }
  bool drives() override {
    const auto hold = robot_.board().hold_tick();
    const protocol::Mode mode = robot_.robot().drive(hold).mode();
    return mode == protocol::Mode::segment || mode == protocol::Mode::velocity ||
           mode == protocol::Mode::wheels;
  }
  bool is_regulated() override {
    const auto hold = robot_.board().hold_tick();
    return robot_.robot().drive(hold).mode() == protocol::Mode::wheels;
  }
  std::uint64_t now_us() override { return robot_.now_us(); }
  std::size_t room(int port) override {
    constexpr std::size_t kRoomOfScanner = 256;
    return port == kScannerPort ? kRoomOfScanner : robot_.board().ports().host_room(port);
  }
  void write(int port, std::span<const std::uint8_t> bytes) override {
    if (port == kScannerPort) return rplidar_->receive(bytes);
    robot_.board().ports().host_write(port, bytes);
  }
  std::size_t read(int port, std::span<std::uint8_t> into) override {
    return port == kScannerPort ? rplidar_->transmit(into) : robot_.board().ports().host_read(port, into);
  }
  std::vector<recording::TruthSample> take_truth() override { return robot_.take_truth(); }
  std::span<const std::uint8_t> flash() override { return robot_.board().flash().content(); }

 private:
  VirtualRobot robot_;
  std::optional<VirtualRplidar> rplidar_;
};

std::unique_ptr<ServedRobot> served(const sim::Config& robot, const MocapConfig& mocap,
                                    const ServerConfig& config) {
  if (config.room) return std::make_unique<ServedVirtualRobot>(robot, mocap, *config.room);
  return std::make_unique<ServedVirtualRobot>(robot, mocap);
}

}  // namespace

Channel::Channel(ServedRobot& robot, int port, std::filesystem::path link)
    : robot_(robot), port_(port), link_(std::move(link)) {
  if (robot_.present(port_))
    pty_.emplace(link_);
  else
    const Pty probe(link_);  // so that a bad path is an error now, not when the port appears
}

pollfd Channel::waits_for() const {
  const int in = robot_.room(port_) != 0
                     ? POLLIN
                     : 0;  // otherwise waiting bytes would wake us although there is no room for them
  return {pty_->fd(), static_cast<short>(in | (outgoing_.empty() ? 0 : POLLOUT)), 0};
}

void Channel::update_connection() {
  if (!robot_.present(port_)) {
    pty_.reset();
    outgoing_.clear();
  } else if (!pty_) {
    pty_.emplace(link_);
  }
  connected_ = pty_ && pty_->connected();
  robot_.set_open(port_, connected_, connected_ ? pty_->baud() : 0);
}

bool Channel::receive() {
  if (!pty_) return false;
  std::array<std::uint8_t, 4096> bytes{};
  const std::size_t room = std::min(bytes.size(), robot_.room(port_));
  const std::size_t count = pty_->read(std::span(bytes).first(room));
  if (count == 0) return false;
  robot_.write(port_, std::span(bytes).first(count));
  return true;
}

bool Channel::transmit() {
  std::array<std::uint8_t, 4096> bytes{};
  std::size_t count = 0;
  while (outgoing_.size() < kMostOutgoing && (count = robot_.read(port_, bytes)) != 0)
    outgoing_.insert(outgoing_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
  if (!connected_) outgoing_.clear();  // nobody listens: the bytes are lost, as on a wire
  if (!outgoing_.empty())
    outgoing_.erase(outgoing_.begin(),
                    outgoing_.begin() + static_cast<std::ptrdiff_t>(pty_->write(outgoing_)));
  return !outgoing_.empty();
}

std::vector<std::uint8_t> load_flash(const fs::path& path) {
  if (path.empty()) return {};
  const fs::file_status status = fs::symlink_status(path);
  if (fs::is_symlink(status))
    throw Error("'" + path.string() +
                    "' is a link, and saving the robot's flash would replace the link: name the file itself",
                ServerProblem::flash_is_link, {path.string()});
  return fs::exists(status) ? load_file(path, kMostFlashBytes) : std::vector<std::uint8_t>{};
}

sim::Config config_of(const RobotOptions& robot, const ServerConfig& server) {
  sim::Config config = with_flash(config_of(robot), server.flash);
  config.serial_number = serial_number_of(server);
  return config;
}

Server::Server(const RobotOptions& robot, const MocapConfig& mocap, const ServerConfig& config)
    : Server(served(config_of(robot, config), mocap, config), config) {}

Server::Server(const sim::Config& robot, const MocapConfig& mocap, const ServerConfig& config)
    : Server(served(with_flash(robot, config.flash), mocap, config), config) {}

Server::Server(std::unique_ptr<ServedRobot> robot, const ServerConfig& config)
    : config_(config), robot_(std::move(robot)), tracker_(config.tracker), pace_(Clock::now()) {
  channels_.emplace_back(*robot_, 0, config.pty);
  if (!config.second_pty.empty()) channels_.emplace_back(*robot_, 1, config.second_pty);
  if (config.room) channels_.emplace_back(*robot_, ServedRobot::kScannerPort, config.scanner_pty);
  truth_.emplace(beside(config.pty, ".mocap"));
  if (!config.second_pty.empty()) truth_->add_link(beside(config.second_pty, ".mocap"));
  const auto content = robot_->flash();
  saved_flash_.assign(content.begin(), content.end());
  claim_flash();
}

Server::~Server() {
  try {
    save_flash();
  } catch (const std::exception&) {  // was reported while running; a destructor cannot
  }
}

void Server::run(const std::function<bool()>& stop) {
  while (!stop()) {
    receive();
    const bool host_is_behind = transmit();
    if (runs_ahead(host_is_behind)) {
      for (int i = lead(*robot_).steps; i > 0; --i) step();
      pace_.restart(Clock::now() + Pace::kStep);
    } else if (pace_.due(Clock::now())) {
      step();
      pace_.stepped();
    } else {
      wait();
    }
  }
  save_flash();  // a failure is reported here; the destructor cannot
}

void Server::receive() {
  truth_->accept_clients();
  tracker_.work();
  bool heard = false;
  for (Channel& channel : channels_) {
    heard |= channel.receive();  // first, so that bytes sent before the port was closed arrive
    channel.update_connection();
  }
  if (!heard) return;
  last_heard_us_ = robot_->now_us();
  turns_waited_ = 0;
  // A step now answers the host at once. Except in fast motion it is one of the steps that are due anyway.
  if (!config_.fast && !pace_.may_step_early(Clock::now())) return;
  step();
  pace_.stepped();
}

/// Saves the flash before bytes are sent, so that a host never hears of data that is not on the disk yet.
bool Server::transmit() {
  save_flash();
  bool behind = truth_->flush();
  for (Channel& channel : channels_) behind |= channel.transmit();
  return behind;
}

bool Server::connected() const {
  return std::any_of(channels_.begin(), channels_.end(), [](const Channel& c) { return c.connected(); });
}

bool Server::host_is_late() {
  const std::uint64_t silence_us = robot_->now_us() - last_heard_us_;
  if (!config_.fast) return silence_us >= kSilenceOfDriver_us && robot_->drives();
  return silence_us >= lead(*robot_).silence_us;
}

/// Virtual time waits for a host that is late because its machine is busy, but only for a limited time if the
/// host hangs, and not at all if it has disconnected.
void Server::wait_for_host() {
  if (!connected() || turns_waited_ >= (config_.fast ? kPatienceInFastMotion : kPatience)) return;
  const Clock::time_point now = Clock::now();
  if (now - turn_at_ >= Pace::kStep) {
    ++turns_waited_;
    turn_at_ = now;
  }
  pace_.restart(now + Pace::kStep);
}

bool Server::runs_ahead(bool host_is_behind) {
  if (host_is_late() || (config_.fast && host_is_behind)) {
    wait_for_host();
    return false;
  }
  turns_waited_ = 0;
  return config_.fast;
}

void Server::step() {
  robot_->step();
  const std::vector<recording::TruthSample> seen = robot_->take_truth();
  for (const recording::TruthSample& sample : seen) truth_->send(sample);
  tracker_.step(seen);
  if (robot_->now_us() < last_heard_us_) last_heard_us_ = 0;  // the robot restarted
}

void Server::wait() {
  const auto until = std::chrono::duration_cast<std::chrono::microseconds>(pace_.next() - Clock::now());
  if (until <= 0us) return;
  if (!connected()) {
    std::this_thread::sleep_for(until);
    return;
  }
  std::vector<pollfd> hosts;
  for (const Channel& channel : channels_)
    if (channel.connected()) hosts.push_back(channel.waits_for());
  const timespec timeout{0, static_cast<long>(std::min<std::int64_t>(until.count(), 20'000) * 1000)};
  ppoll(hosts.data(), hosts.size(), &timeout, nullptr);
}

void Server::claim_flash() {
  if (config_.flash.empty()) return;
  std::error_code none;
  if (fs::exists(config_.flash, none) && access(config_.flash.c_str(), W_OK) != 0)
    throw Error(fmt::format("the robot's flash '{}' cannot be written: {}", config_.flash.string(),
                            system_reason(errno)));
  const PartFile probe(config_.flash);
  flash_claim_ = PathClaim::of(config_.flash);
  if (!flash_claim_)
    throw Error(fmt::format("the robot's flash '{}' is in use by another simulator", config_.flash.string()),
                ServerProblem::flash_in_use, {config_.flash.string()});
}

void Server::save_flash() {
  const auto content = robot_->flash();
  if (config_.flash.empty() || std::equal(content.begin(), content.end(), saved_flash_.begin())) return;
  PartFile file(config_.flash);
  file.write(content);
  file.commit();
  saved_flash_.assign(content.begin(), content.end());
}

}  // namespace astro::simulation
