#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/simulation/robot/virtual_scanner.hpp"
#include "host/truth/scanners/rplidar_nodes.hpp"

namespace astro::simulation {

/// An RPLIDAR that is well, or not.
struct RplidarConfig {
  truth::rplidar::Info info{
      .model = 0x18, .firmware_minor = 29, .firmware_major = 1, .hardware = 5, .serial = {}};  // an A1M8
  truth::rplidar::Health health{};
  bool reset_heals = true;
  /// In express mode it sends all beams of its scanner, in capsules; otherwise each one of so many. 1: it has no express mode.
  int beams_for_node = 1;
  truth::rplidar::AnswerType express = truth::rplidar::AnswerType::capsules;
};

/// The electronics of an RPLIDAR around a virtual scanner: it answers requests and sends what the scanner measures, as bytes.
class VirtualRplidar {
 public:
  VirtualRplidar(const RplidarConfig& config, const ScannerConfig& scanner);

  /// Bytes from the host.
  void receive(std::span<const std::uint8_t> bytes);
  /// To be called with the beams of each step.
  void measure(std::span<const VirtualScanner::Beam> beams);
  /// Moves bytes for the host and returns their number.
  std::size_t transmit(std::span<std::uint8_t> into);

  bool is_scanning() const { return mode_ != Mode::idle; }

 private:
  enum class Mode { idle, nodes, capsules };

  void obey(truth::rplidar::Command command);
  void answer(truth::rplidar::AnswerType type, ByteView content);
  void start(Mode mode);

  RplidarConfig config_;
  ScannerConfig scanner_;
  Mode mode_ = Mode::idle;
  bool restarts_ = false;  // the next capsule is the first of a scan
  Bytes requests_, outgoing_;
  std::vector<truth::rplidar::Node> capsule_;
};

}  // namespace astro::simulation
