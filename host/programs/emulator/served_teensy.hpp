#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/descriptor.hpp"
#include "host/emulator/robot/emulated_robot.hpp"
#include "host/simulation/server/served_robot.hpp"
#include "host/simulation/server/server.hpp"

namespace astro::emulator {

/// Loads an image into an emulated Teensy that waits in its boot loader, through a FIFO that exists as long
/// as the object. A program that writes an image into it stands in for teensy_loader_cli:
///
///   cat firmware.hex > robot.halfkay
class HalfKay {
 public:
  /// Throws astro::Error if the FIFO cannot be made.
  explicit HalfKay(std::filesystem::path fifo);
  ~HalfKay();
  HalfKay(const HalfKay&) = delete;
  HalfKay& operator=(const HalfKay&) = delete;

  /// The image, when it was written completely; nothing before. Never blocks.
  std::optional<std::string> receive();

 private:
  std::filesystem::path path_;
  Descriptor fifo_;
  std::string received_;
};

/// An emulated robot behind ptys: port 0 is LPUART6, port 1 is USB. In its boot loader it waits for an image
/// at the path of its pty + ".halfkay"; flashing keeps the sectors of the parameters, as on a Teensy.
class ServedTeensy : public simulation::ServedRobot {
 public:
  /// The robot of config_of(robot, server). Throws what that and Teensy throw.
  ServedTeensy(const std::filesystem::path& hex, const simulation::RobotOptions& robot,
               const simulation::MocapConfig& mocap, const simulation::ServerConfig& server);
  ~ServedTeensy() override;

  void step() override;
  std::uint64_t now_us() override { return robot_->teensy().now_us(); }
  std::size_t room(int port) override;
  void write(int port, std::span<const std::uint8_t> bytes) override;
  std::size_t read(int port, std::span<std::uint8_t> into) override;
  bool present(int port) override;
  void set_open(int port, bool open, std::uint32_t baud) override;
  std::vector<recording::TruthSample> take_truth() override { return robot_->take_truth(); }
  std::span<const std::uint8_t> flash() override { return robot_->teensy().flash().parameters(); }

 private:
  void start(const std::filesystem::path& hex);
  void wait_in_bootloader();

  sim::Config config_;
  simulation::MocapConfig mocap_;
  std::filesystem::path fifo_, flashed_;
  std::unique_ptr<EmulatedRobot> robot_;
  std::optional<HalfKay> halfkay_;
  std::uint64_t due_us_ = 0;  // the chip's time at the end of the next step
};

}  // namespace astro::emulator
