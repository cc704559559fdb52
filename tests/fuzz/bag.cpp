// Bags of all storages, packed or not, and the wheels and poses in them.
#include "host/formats/files/bag.hpp"
#include "host/base/error.hpp"
#include "host/formats/files/compression.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/formats/files/sqlite.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/joint_state.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/formats/messages/stamped_pose.hpp"
#include "host/import/bags/bag_wheels.hpp"
#include "host/import/bags/pose_topics.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/ros1/ros1_bag.hpp"

namespace astro::fuzz {
namespace {

using namespace bag;  // NOLINT(google-build-using-namespace): this file is all recordings
using fuzz::Bytes;
using fuzz::ByteView;

template <class Read>
void try_to(Read read) {
  try {
    read();
  } catch (const Error&) {
  }
}

Bytes joints() { return ros2::encode_joint_state({5, {"left_wheel", "right_wheel"}, {1, 2}, {3, 4}, {}}); }
Bytes transform() { return ros2::encode_tf({{5, "map", "base", 1, 2, 3, 0, 0, 0, 1}}); }

Bytes mcap_bag() {
  Bytes file;
  McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "fuzz"});
  const auto add = [&](const ros2::RosType& type, const char* topic, const Bytes& data) {
    const auto channel = writer.add_channel(writer.add_schema(type.name, "ros2msg", "x"), topic, "cdr", {});
    for (std::uint64_t i = 0; i < 3; ++i) writer.write(channel, i, data);
  };
  add(ros2::joint_state_type(), "/joint_states", joints());
  add(ros2::tf_message_type(), "/tf", transform());
  writer.close();
  return file;
}

Bytes database_bag() {
  sqlite3* raw = nullptr;
  sqlite3_open(":memory:", &raw);
  const Database database(raw);
  sqlite3_exec(
      raw,
      "PRAGMA page_size=512;CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT,type TEXT,"
      "serialization_format TEXT);CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER,timestamp "
      "INTEGER,data BLOB);INSERT INTO topics VALUES(1,'/joint_states','sensor_msgs/msg/JointState','cdr'),"
      "(2,'/tf','tf2_msgs/msg/TFMessage','cdr');",
      nullptr, nullptr, nullptr);
  const Bytes messages[] = {joints(), transform()};
  for (int i = 0; i < 6; ++i) {
    Statement insert(raw, "INSERT INTO messages(topic_id,timestamp,data) VALUES(?,?,?)");
    insert.bind(1, std::int64_t{1 + i % 2});
    insert.bind(2, std::int64_t{i});
    insert.bind(3, ByteView(messages[i % 2]));
    insert.step();
  }
  sqlite3_int64 size = 0;
  unsigned char* image = sqlite3_serialize(raw, "main", &size, 0);
  Bytes file(image, image + size);
  sqlite3_free(image);
  return file;
}

Bytes ros1_bag(const char* compression) {
  support::Ros1Bag bag(compression);
  bag.topic(0, "/joint_states", "sensor_msgs/JointState", support::ros1::kJointState);
  bag.topic(1, "/tf", "tf/tfMessage", support::ros1::kTf);
  bag.topic(2, "/left_ticks", "std_msgs/Int32", "int32 data");
  bag.topic(3, "/right_ticks", "std_msgs/Int32", "int32 data");
  for (int i = 0; i < 3; ++i) {
    bag.message(0, i,
                support::Ros1Message::encode(ros2::msg::JointState{{}, {"left", "right"}, {1, 2}, {}, {}}));
    bag.message(1, i, support::Ros1Message::encode(ros2::msg::TFMessage{{{{}, "base", {}}}}));
    bag.message(2, i, Bytes(4));
    bag.message(3, i, Bytes(4));
    if (i == 1) bag.end_chunk();
  }
  return bag.closed();
}

}  // namespace

void take(ByteView input) {
  static const InputFile file("bag");
  const std::filesystem::path path = file.holding(input);
  BagHandlers handlers;
  std::uint64_t passed = 0;
  handlers.message = [&](const BagTopic&, const BagMessage&) { ++passed; };
  try_to([&] {
    const BagReport report = read_bag(path, handlers);
    std::uint64_t counted = 0;
    for (const BagTopic& topic : report.topics) counted += topic.messages;
    require(passed <= counted, "every message that is passed on is counted");
    require(report.damaged || passed == counted, "only damaged messages are left out");
  });
  try_to([&] { importing::wheels_in_bag(path); });
  importing::BagWheelSelection selection;
  selection.measure = importing::travel_measure("rpm");
  selection.topic = "/left_ticks,/right_ticks";
  try_to([&] { importing::wheels_in_bag(path, selection); });
  selection = {"/tf", {}, {}, {}, calibration::WheelFactors{1, 1, 0.3}};
  try_to([&] { importing::wheels_in_bag(path, selection); });
  try_to([&] { importing::poses_in_bag(path); });
  try_to([&] { importing::poses_in_bag(path, {"/tf", "", ""}); });
}

std::vector<Bytes> seeds() {
  return {mcap_bag(),
          database_bag(),
          compress_zstd(mcap_bag()),
          compress_zstd(database_bag()),
          ros1_bag("none"),
          ros1_bag("bz2"),
          ros1_bag("lz4")};
}

}  // namespace astro::fuzz
