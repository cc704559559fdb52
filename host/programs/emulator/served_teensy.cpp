#include "host/programs/emulator/served_teensy.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"

namespace astro::emulator {
namespace {

namespace fs = std::filesystem;

Port port_of(int number) { return number == 0 ? Port::serial : Port::usb; }

fs::path beside(fs::path path, const char* suffix) { return path += suffix; }

}  // namespace

HalfKay::HalfKay(fs::path fifo) : path_(std::move(fifo)) {
  if (mkfifo(path_.c_str(), 0600) == 0) fifo_.reset(open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!fifo_)
    throw Error(
        fmt::format("the boot loader's '{}' cannot be made: {}", path_.string(), std::strerror(errno)));
}

HalfKay::~HalfKay() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

std::optional<std::string> HalfKay::receive() {
  std::array<char, 4096> bytes{};
  ssize_t count = 0;
  while ((count = read(fifo_.get(), bytes.data(), bytes.size())) > 0)
    received_.append(bytes.data(), static_cast<std::size_t>(count));
  const bool closed = count == 0;  // by the writer, or no writer has opened it yet
  if (!closed || received_.empty()) return {};
  return std::exchange(received_, {});
}

ServedTeensy::ServedTeensy(const fs::path& hex, const simulation::RobotOptions& robot,
                           const simulation::MocapConfig& mocap, const simulation::ServerConfig& server)
    : config_(config_of(robot, server)),
      mocap_(mocap),
      fifo_(beside(server.pty, ".halfkay")),
      flashed_(beside(server.pty, ".flashed.hex")) {
  std::error_code none;
  if (fs::is_fifo(fifo_, none))
    fs::remove(fifo_, none);  // left by a killed program; a loader would wait for it
  start(hex);
}

ServedTeensy::~ServedTeensy() {
  std::error_code ignored;
  fs::remove(flashed_, ignored);
}

void ServedTeensy::start(const fs::path& hex) {
  robot_ = std::make_unique<EmulatedRobot>(hex, config_, mocap_);
  due_us_ = 0;
}

void ServedTeensy::step() {
  // By the chip's time, because some actions of the computer at the USB port, such as enumeration, let time
  // pass.
  constexpr std::uint64_t kMillisecond_us = 1000;
  due_us_ += kMillisecond_us;
  while (now_us() < due_us_) robot_->step();
  if (robot_->teensy().in_bootloader()) wait_in_bootloader();
}

void ServedTeensy::wait_in_bootloader() {
  if (!halfkay_) {
    halfkay_.emplace(fifo_);
    console::say("the robot is in its boot loader: flash it with cat IMAGE.hex > " + fifo_.string());
  }
  const auto image = halfkay_->receive();
  if (!image) return;
  const auto kept = flash();
  config_.flash.assign(kept.begin(), kept.end());
  try {
    PartFile file(flashed_);
    file.write(as_bytes(*image));
    file.commit();
    start(flashed_);
  } catch (const Error& error) {
    return console::complain(commands::in_words(error));
  }
  halfkay_.reset();
  console::say("flashed");
}

std::size_t ServedTeensy::room(int port) {
  constexpr std::size_t kUnderway = 1024;  // buffer of an adapter or an operating system
  return kUnderway - std::min(kUnderway, robot_->underway(port_of(port)));
}

void ServedTeensy::write(int port, std::span<const std::uint8_t> bytes) {
  robot_->send(port_of(port), bytes);
}

std::size_t ServedTeensy::read(int port, std::span<std::uint8_t> into) {
  return robot_->receive(port_of(port), into);
}

bool ServedTeensy::present(int port) { return port_of(port) == Port::serial || robot_->usb().present(); }

void ServedTeensy::set_open(int port, bool open, std::uint32_t baud) {
  if (port_of(port) != Port::usb) return;
  if (open)
    robot_->usb().open(baud);
  else
    robot_->usb().close();
}

}  // namespace astro::emulator
