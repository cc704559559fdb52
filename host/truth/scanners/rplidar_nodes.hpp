#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/truth/scanners/rplidar_packets.hpp"

/// The measurements of an RPLIDAR as bytes, in the three forms in which its models send them.
///
///   nodes           5 bytes: quality and start flag with its inverse, angle with a constant bit, range in 1/4 mm
///   capsules        84 bytes: two sync nibbles with a checksum, the angle of the first measurement, 16 pairs of ranges in mm,
///                   each with the angle by which it was compensated
///   dense capsules  84 bytes: the same with 40 ranges in mm and no compensation
///
/// The angles within a capsule are spread evenly up to the first angle of the next one, so a capsule is understood only when the
/// next one has come.
///
/// Source  as rplidar_packets.hpp, the sections on SCAN and EXPRESS_SCAN. The notes call a compensation signed; the maker's own
///         programs read all six bits as a positive number, and so do we.
namespace astro::truth::rplidar {

struct Node {
  double angle_rad = 0;    // clockwise as seen from the scanner's top, from its x axis on, in [0, 2 pi)
  double range_m = 0;      // 0: nothing was seen
  std::int64_t count = 0;  // of measurements before this one
  bool starts_turn = false;
  bool follows = true;  // directly on the one before; false: an unknown number was lost in between

  bool operator==(const Node&) const = default;
};

inline constexpr std::size_t kNodeBytes = 5, kCapsuleBytes = 84;

/// How many measurements a capsule of this type holds.
constexpr std::size_t nodes_of(AnswerType type) { return type == AnswerType::dense_capsules ? 40 : 32; }

/// Bytes of measurements to measurements, however the bytes are cut. Where bytes were lost or changed, it finds the next place
/// from which on the bytes make sense.
class NodeReader {
 public:
  /// `type`: one of the three with measurements.
  explicit NodeReader(AnswerType type);

  /// The measurements that these bytes complete.
  std::vector<Node> take(ByteView bytes);

  /// How many measurements have come whole, with those that wait for the next capsule.
  std::int64_t received() const { return received_; }
  /// Bytes that made no sense, since the beginning.
  std::int64_t skipped_bytes() const { return skipped_; }

 private:
  std::size_t take_node(ByteView bytes, std::vector<Node>& nodes);
  std::size_t take_capsule(ByteView bytes, std::vector<Node>& nodes);
  bool is_in_step(ByteView bytes) const;
  void unpack_previous(double next_angle_deg, std::vector<Node>& nodes);
  std::size_t lose_step();
  void keep(Node node, std::vector<Node>& nodes);

  AnswerType type_;
  Bytes waiting_;
  bool in_step_ = false, follows_ = false;
  std::int64_t received_ = 0, skipped_ = 0;
  Bytes previous_;              // the capsule whose successor has not come
  double last_angle_deg_ = -1;  // of the last measurement in a capsule
};

/// For the scanner's side. Precondition of a capsule: as many measurements as it has.
Bytes node_bytes(const Node& node);
/// `restarts`: the first capsule of a scan, or one that does not follow the last one.
Bytes capsule_bytes(AnswerType type, std::span<const Node> nodes, bool restarts);

}  // namespace astro::truth::rplidar
