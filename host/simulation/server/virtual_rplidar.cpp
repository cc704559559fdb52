#include "host/simulation/server/virtual_rplidar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace astro::simulation {
namespace {

namespace rplidar = truth::rplidar;

constexpr std::size_t kMostUnread = 1U << 16;  // beyond it a host that does not read loses measurements

/// An RPLIDAR counts angles clockwise, as it turns.
rplidar::Node node_of(const VirtualScanner::Beam& beam, int beams) {
  return {2 * std::numbers::pi * beam.index / beams,
          std::isnan(beam.range_m) ? 0.0 : static_cast<double>(beam.range_m), 0, beam.index == 0};
}

rplidar::SampleTimes times_of(const RplidarConfig& config, const ScannerConfig& scanner) {
  const double beam_us = 1e6 / (scanner.turns_per_s * scanner.beams);
  rplidar::SampleTimes times;
  times.standard_us = static_cast<std::uint16_t>(std::lround(beam_us * config.beams_for_node));
  times.express_us =
      config.beams_for_node > 1 ? static_cast<std::uint16_t>(std::lround(beam_us)) : times.standard_us;
  return times;
}

}  // namespace

VirtualRplidar::VirtualRplidar(const RplidarConfig& config, const ScannerConfig& scanner)
    : config_(config), scanner_(scanner) {}

void VirtualRplidar::receive(std::span<const std::uint8_t> bytes) {
  append(requests_, bytes);
  while (const auto command = rplidar::take_request(requests_)) obey(*command);
}

void VirtualRplidar::obey(rplidar::Command command) {
  using rplidar::AnswerType, rplidar::Command;
  if (command == Command::set_motor_pwm) return;
  mode_ = Mode::idle;  // every other request ends a scan
  const bool works = config_.health.status != rplidar::HealthStatus::error;
  switch (command) {
    case Command::get_info:
      return answer(AnswerType::info, to_bytes(config_.info));
    case Command::get_health:
      return answer(AnswerType::health, to_bytes(config_.health));
    case Command::get_sample_rate:
      return answer(AnswerType::sample_rate, to_bytes(times_of(config_, scanner_)));
    case Command::scan:
      if (works) start(Mode::nodes);
      return;
    case Command::express_scan:
      if (works && config_.beams_for_node > 1) start(Mode::capsules);
      return;
    case Command::reset:
      if (config_.reset_heals) config_.health = {};
      append(outgoing_, as_bytes("RP LIDAR System.\r\nFirmware Ver 1.29\r\n"));
      return;
    default:
      return;
  }
}

void VirtualRplidar::answer(rplidar::AnswerType type, ByteView content) {
  append(outgoing_, to_bytes(rplidar::Descriptor{type, static_cast<std::uint32_t>(content.size()), false}));
  append(outgoing_, content);
}

void VirtualRplidar::start(Mode mode) {
  const bool nodes = mode == Mode::nodes;
  append(outgoing_,
         to_bytes(rplidar::Descriptor{
             nodes ? rplidar::AnswerType::nodes : config_.express,
             static_cast<std::uint32_t>(nodes ? rplidar::kNodeBytes : rplidar::kCapsuleBytes), true}));
  mode_ = mode;
  restarts_ = true;
  capsule_.clear();
}

void VirtualRplidar::measure(std::span<const VirtualScanner::Beam> beams) {
  if (mode_ == Mode::idle || outgoing_.size() > kMostUnread) return;
  for (const VirtualScanner::Beam& beam : beams) {
    const rplidar::Node node = node_of(beam, scanner_.beams);
    if (mode_ == Mode::nodes) {
      if (beam.index % config_.beams_for_node == 0) append(outgoing_, rplidar::node_bytes(node));
      continue;
    }
    capsule_.push_back(node);
    if (capsule_.size() < rplidar::nodes_of(config_.express)) continue;
    append(outgoing_, rplidar::capsule_bytes(config_.express, capsule_, restarts_));
    restarts_ = false;
    capsule_.clear();
  }
}

std::size_t VirtualRplidar::transmit(std::span<std::uint8_t> into) {
  const std::size_t count = std::min(into.size(), outgoing_.size());
  std::copy_n(outgoing_.begin(), count, into.begin());
  outgoing_.erase(outgoing_.begin(), outgoing_.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

}  // namespace astro::simulation
