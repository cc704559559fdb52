#pragma once

#include <bzlib.h>
#include <lz4frame.h>

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/base/bytes.hpp"
#include "tests/support/ros2/message_encoder.hpp"

/// Bags and messages as ROS 1 writes them, by code that has nothing in common with their readers.
namespace astro::support {

/// A bag of format 2.0.
class Ros1Bag {
 public:
  /// `compression`: "none", "bz2" or "lz4".
  explicit Ros1Bag(std::string compression = "none") : compression_(std::move(compression)) {
    append(file_, as_bytes("#ROSBAG V2.0\n"));
    append(file_, head_record(0, 0));
  }

  void topic(std::uint32_t id, const std::string& name, const std::string& type,
             const std::string& definition) {
    Bytes data;
    for (const auto& [key, value] : {std::pair<std::string, std::string>{"callerid", "/play_1"},
                                     {"latching", "1"},
                                     {"md5sum", "0123456789abcdef0123456789abcdef"},
                                     {"message_definition", definition},
                                     {"topic", name},
                                     {"type", type}})
      append(data, field(key, as_bytes(value)));
    connections_[id] = record(7, {{"conn", bytes_of(id)}, {"topic", bytes_of(name)}}, data);
  }

  void message(std::uint32_t topic, std::int64_t time_ns, ByteView data) {
    if (!in_chunk_[topic]++) append(chunk_, connections_.at(topic));
    const auto sec = static_cast<std::uint32_t>(time_ns / 1'000'000'000),
               nsec = static_cast<std::uint32_t>(time_ns % 1'000'000'000);
    Bytes time = bytes_of(sec);
    append(time, nsec);
    append(chunk_, record(2, {{"conn", bytes_of(topic)}, {"time", time}}, data));
  }

  std::size_t open_bytes() const { return chunk_.size(); }

  void end_chunk() {
    const Bytes packed = pack(chunk_);
    add_chunk(packed, static_cast<std::uint32_t>(chunk_.size()), static_cast<std::uint32_t>(packed.size()));
    for (const auto& [topic, messages] : in_chunk_) {  // the index of a chunk
      Bytes count = bytes_of(static_cast<std::uint32_t>(messages));
      append(file_,
             record(4, {{"ver", bytes_of(std::uint32_t{1})}, {"conn", bytes_of(topic)}, {"count", count}},
                    Bytes(12 * static_cast<std::size_t>(messages))));
    }
    chunk_.clear();
    in_chunk_.clear();
    ++chunks_;
  }

  /// A chunk that says of its lengths what it likes. That of a recorder that was killed says 0.
  void add_chunk(ByteView packed, std::uint32_t size, std::uint32_t packed_bytes) {
    Bytes head = record(5, {{"compression", bytes_of(compression_)}, {"size", bytes_of(size)}}, {});
    store(std::span(head), head.size() - 4, packed_bytes);
    append(file_, head);
    append(file_, packed);
  }

  /// What a killed recorder leaves: the last chunk has no lengths yet, and the file no index.
  Bytes killed() const {
    Ros1Bag copy = *this;
    copy.add_chunk(pack(chunk_), 0, 0);
    return copy.file_;
  }

  const Bytes& file() const { return file_; }

  const Bytes& closed() {
    if (!chunk_.empty()) end_chunk();
    index_at_ = file_.size();
    for (const auto& [id, connection] : connections_) append(file_, connection);
    for (std::uint32_t i = 0; i < chunks_; ++i)
      append(file_, record(6,
                           {{"ver", bytes_of(std::uint32_t{1})},
                            {"chunk_pos", Bytes(8)},
                            {"start_time", Bytes(8)},
                            {"end_time", Bytes(8)},
                            {"count", Bytes(4)}},
                           {}));
    const Bytes head = head_record(index_at_, chunks_);
    std::copy(head.begin(), head.end(), file_.begin() + 13);
    return file_;
  }
  /// Where the index of a closed bag begins.
  std::size_t index_at() const { return index_at_; }

  Bytes pack(ByteView bytes) const {
    if (compression_ == "bz2") return bz2(bytes);
    if (compression_ == "lz4") return lz4(bytes);
    return {bytes.begin(), bytes.end()};
  }

 private:
  using Fields = std::vector<std::pair<std::string, Bytes>>;

  static Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }
  static Bytes bytes_of(std::uint32_t value) {
    Bytes bytes;
    append(bytes, value);
    return bytes;
  }

  static Bytes field(const std::string& key, ByteView value) {
    Bytes out = bytes_of(static_cast<std::uint32_t>(key.size() + 1 + value.size()));
    append(out, as_bytes(key));
    out.push_back('=');
    append(out, value);
    return out;
  }

  static Bytes record(std::uint8_t op, const Fields& fields, ByteView data) {
    Bytes head;
    append(head, field("op", Bytes{op}));
    for (const auto& [key, value] : fields) append(head, field(key, value));
    Bytes out = bytes_of(static_cast<std::uint32_t>(head.size()));
    append(out, head);
    append(out, static_cast<std::uint32_t>(data.size()));
    append(out, data);
    return out;
  }

  /// The record that every bag begins with is padded, so that it can be written again at the end.
  Bytes head_record(std::uint64_t index_at, std::uint32_t chunks) const {
    constexpr std::size_t kBytes = 4096;
    Bytes at;
    append(at, index_at);
    const Fields fields{{"index_pos", at},
                        {"conn_count", bytes_of(static_cast<std::uint32_t>(connections_.size()))},
                        {"chunk_count", bytes_of(chunks)}};
    const std::size_t head = record(3, fields, {}).size();
    return record(3, fields, Bytes(kBytes - head, ' '));
  }

  static Bytes bz2(ByteView bytes) {
    Bytes out(bytes.size() + bytes.size() / 100 + 600);
    auto size = static_cast<unsigned>(out.size());
    auto* from = const_cast<char*>(as_text(bytes).data());
    if (BZ2_bzBuffToBuffCompress(reinterpret_cast<char*>(out.data()), &size, from,
                                 static_cast<unsigned>(bytes.size()), 9, 0, 0) != BZ_OK)
      throw std::runtime_error("bz2");
    out.resize(size);
    return out;
  }

  static Bytes lz4(ByteView bytes) {
    Bytes out(LZ4F_compressFrameBound(bytes.size(), nullptr));
    out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
    return out;
  }

  std::string compression_;
  Bytes file_, chunk_;
  std::map<std::uint32_t, Bytes> connections_;
  std::map<std::uint32_t, int> in_chunk_;  // messages of each topic
  std::uint32_t chunks_ = 0;
  std::size_t index_at_ = 0;
};

/// Definitions as they stand in bags of ROS 1.
namespace ros1 {

inline const std::string kRule(80, '=');
inline const std::string kHeader = kRule +
                                   "\nMSG: std_msgs/Header\n# Standard metadata for higher-level stamped "
                                   "data types.\n#\n# sequence ID: consecutively "
                                   "increasing ID \nuint32 seq\n#Two-integer timestamp\ntime stamp\n#Frame "
                                   "this data is associated with\nstring frame_id\n";
inline const std::string kPoint = kRule + "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n";
inline const std::string kQuaternion =
    kRule + "\nMSG: geometry_msgs/Quaternion\n\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n";
inline const std::string kPose =
    kRule + "\nMSG: geometry_msgs/Pose\n# A pose\nPoint position\nQuaternion orientation\n\n" + kPoint +
    kQuaternion;
inline const std::string kVector = kRule + "\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";

inline const std::string kJointState =
    "Header header\n\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n\n" + kHeader;
inline const std::string kPoseStamped =
    "# A Pose with reference coordinate frame and timestamp\nHeader header\nPose pose\n\n" + kHeader + kPose;
inline const std::string kTf =
    "geometry_msgs/TransformStamped[] transforms\n\n" + kRule +
    "\nMSG: geometry_msgs/TransformStamped\nHeader header\nstring child_frame_id # the frame id of the child "
    "frame\n"
    "Transform transform\n\n" +
    kHeader + kRule + "\nMSG: geometry_msgs/Transform\nVector3 translation\nQuaternion rotation\n\n" +
    kVector + kQuaternion;
inline const std::string kOdometry =
    "Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
    "geometry_msgs/TwistWithCovariance twist\n\n" +
    kHeader + kRule + "\nMSG: geometry_msgs/PoseWithCovariance\nPose pose\nfloat64[36] covariance\n\n" +
    kPose + kRule + "\nMSG: geometry_msgs/TwistWithCovariance\nTwist twist\nfloat64[36] covariance\n\n" +
    kRule + "\nMSG: geometry_msgs/Twist\nVector3  linear\nVector3  angular\n\n" + kVector;

}  // namespace ros1
}  // namespace astro::support
