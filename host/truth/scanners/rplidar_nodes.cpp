#include "host/truth/scanners/rplidar_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace astro::truth::rplidar {
namespace {

constexpr double kTurn_deg = 360, kRadPerDegree = std::numbers::pi / 180;
constexpr double kQ3 = 8, kQ6 = 64;  // fractions of a degree
constexpr double kQuarterMillimetre = 0.00025, kMillimetre = 0.001;
constexpr std::uint16_t kAngleBits = 0x7FFF, kRestartBit = 0x8000;
constexpr std::size_t kNodesInARow = 6;  // that must make sense before measurements are believed again
constexpr std::uint8_t kQuality = 47;    // of a good measurement, which nobody here reads

/// The start flag stands beside its inverse, one bit is constant, and angles are below a turn: random bytes pass one in six times.
bool may_be_node(ByteView bytes) {
  const bool start = (bytes[0] & 1U) != 0, not_start = (bytes[0] & 2U) != 0;
  return start != not_start && (bytes[1] & 1U) != 0 &&
         load<std::uint16_t>(bytes, 1) >> 1U < static_cast<unsigned>(kTurn_deg * kQ6);
}

std::uint8_t capsule_checksum(ByteView capsule) {
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : capsule.subspan(2)) sum = static_cast<std::uint8_t>(sum ^ byte);
  return sum;
}

bool is_capsule(ByteView bytes) {
  return bytes[0] >> 4U == 0xA && bytes[1] >> 4U == 0x5 &&
         ((bytes[0] & 0xFU) | (bytes[1] & 0xFU) << 4U) == capsule_checksum(bytes);
}

double start_angle_deg(ByteView capsule) { return (load<std::uint16_t>(capsule, 2) & kAngleBits) / kQ6; }

struct Cabin {
  double range_m = 0, compensation_deg = 0;
};

/// A range takes 14 bits; below it stand the upper two bits of the compensation, whose other four are in the fifth byte.
Cabin cabin_of(ByteView capsule, AnswerType type, std::size_t i) {
  if (type == AnswerType::dense_capsules) return {load<std::uint16_t>(capsule, 4 + 2 * i) * kMillimetre, 0};
  const ByteView pair = capsule.subspan(4 + 5 * (i / 2), 5);
  const bool second = i % 2 != 0;
  const auto word = load<std::uint16_t>(pair, second ? 2 : 0);
  const unsigned low = second ? pair[4] >> 4U : pair[4] & 0xFU;
  return {(word >> 2U) * kMillimetre, ((word & 3U) << 4U | low) / kQ3};
}

double within_turn_deg(double angle_deg) {
  const double rest = std::fmod(angle_deg, kTurn_deg);
  return rest < 0 ? rest + kTurn_deg : rest;
}

std::uint16_t in_q(double value, double unit, std::uint16_t most) {
  return static_cast<std::uint16_t>(std::clamp(std::round(value / unit), 0.0, static_cast<double>(most)));
}

std::uint16_t angle_in_q6(double angle_rad) {
  const auto angle = in_q(angle_rad / kRadPerDegree, 1 / kQ6, kAngleBits);
  return static_cast<std::uint16_t>(angle % static_cast<unsigned>(kTurn_deg * kQ6));
}

}  // namespace

NodeReader::NodeReader(AnswerType type) : type_(type) {}

std::vector<Node> NodeReader::take(ByteView bytes) {
  append(waiting_, bytes);
  std::vector<Node> nodes;
  std::size_t at = 0;
  while (true) {
    const ByteView rest = ByteView(waiting_).subspan(at);
    const std::size_t used = type_ == AnswerType::nodes ? take_node(rest, nodes) : take_capsule(rest, nodes);
    if (used == 0) break;
    at += used;
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(at));
  return nodes;
}

void NodeReader::keep(Node node, std::vector<Node>& nodes) {
  node.follows = std::exchange(follows_, true);
  nodes.push_back(node);
}

std::size_t NodeReader::lose_step() {
  in_step_ = follows_ = false;
  previous_.clear();
  ++skipped_;
  return 1;
}

/// Whether enough nodes in a row make sense, from this byte on.
bool NodeReader::is_in_step(ByteView bytes) const {
  for (std::size_t i = 0; i < kNodesInARow; ++i)
    if (!may_be_node(bytes.subspan(i * kNodeBytes))) return false;
  return true;
}

/// Returns how many bytes it has used; 0 if more must come.
std::size_t NodeReader::take_node(ByteView bytes, std::vector<Node>& nodes) {
  if (bytes.size() < (in_step_ ? 1 : kNodesInARow) * kNodeBytes) return 0;
  if (!(in_step_ ? may_be_node(bytes) : is_in_step(bytes))) return lose_step();
  in_step_ = true;
  keep({(load<std::uint16_t>(bytes, 1) >> 1U) / kQ6 * kRadPerDegree,
        load<std::uint16_t>(bytes, 3) * kQuarterMillimetre, received_++, (bytes[0] & 1U) != 0},
       nodes);
  return kNodeBytes;
}

std::size_t NodeReader::take_capsule(ByteView bytes, std::vector<Node>& nodes) {
  if (bytes.size() < kCapsuleBytes) return 0;
  const ByteView capsule = bytes.first(kCapsuleBytes);
  if (!is_capsule(capsule)) return lose_step();
  if ((load<std::uint16_t>(capsule, 2) & kRestartBit) != 0) {
    previous_.clear();
    follows_ = false;
  }
  if (!previous_.empty()) unpack_previous(start_angle_deg(capsule), nodes);
  previous_.assign(capsule.begin(), capsule.end());
  received_ += static_cast<std::int64_t>(nodes_of(type_));
  return kCapsuleBytes;
}

void NodeReader::unpack_previous(double next_angle_deg, std::vector<Node>& nodes) {
  const double first_deg = start_angle_deg(previous_);
  const auto count = nodes_of(type_);
  const double step_deg = within_turn_deg(next_angle_deg - first_deg) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double beam_deg = within_turn_deg(first_deg + static_cast<double>(i) * step_deg);
    const Cabin cabin = cabin_of(previous_, type_, i);
    keep({within_turn_deg(beam_deg - cabin.compensation_deg) * kRadPerDegree, cabin.range_m,
          received_ - static_cast<std::int64_t>(count - i), beam_deg < last_angle_deg_},
         nodes);
    last_angle_deg_ = beam_deg;
  }
}

Bytes node_bytes(const Node& node) {
  Bytes bytes;
  append(bytes,
         static_cast<std::uint8_t>((node.range_m > 0 ? kQuality : 0) << 2U | (node.starts_turn ? 1U : 2U)));
  append(bytes, static_cast<std::uint16_t>(angle_in_q6(node.angle_rad) << 1U | 1U));
  append(bytes, in_q(node.range_m, kQuarterMillimetre, 0xFFFF));
  return bytes;
}

Bytes capsule_bytes(AnswerType type, std::span<const Node> nodes, bool restarts) {
  Bytes bytes;
  append(bytes, std::uint16_t{0});  // sync and checksum, filled in below
  append(bytes,
         static_cast<std::uint16_t>(angle_in_q6(nodes.front().angle_rad) | (restarts ? kRestartBit : 0U)));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool dense = type == AnswerType::dense_capsules;
    const auto range = in_q(nodes[i].range_m, kMillimetre, dense ? 0xFFFF : 0x3FFF);
    append(bytes, static_cast<std::uint16_t>(dense ? range : range << 2U));
    if (!dense && i % 2 != 0) bytes.push_back(0);  // no compensation
  }
  const std::uint8_t sum = capsule_checksum(bytes);
  bytes[0] = static_cast<std::uint8_t>(0xA0U | (sum & 0xFU));
  bytes[1] = static_cast<std::uint8_t>(0x50U | sum >> 4U);
  return bytes;
}

}  // namespace astro::truth::rplidar
