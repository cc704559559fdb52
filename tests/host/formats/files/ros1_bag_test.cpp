#include <gmock/gmock.h>

#include "host/base/error.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/std.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/mutations.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/ros1/ros1_bag.hpp"

namespace astro::bag {
namespace {

namespace fs = std::filesystem;
using made_bags::save;
using support::measured;
using support::Ros1Bag;
using support::Ros1Message;
using support::Taken;
using support::ThrowsTelling;
using ::testing::HasSubstr;

constexpr std::int64_t kStart_ns = 1'600'000'000'000'000'000;
constexpr int kPerChunk = 10;

ros2::msg::PoseStamped pose(int i) {
  return {ros2::msg::Header{ros2::msg::to_time(kStart_ns + i), "map"}, {{1.5 * i, 2, 3}, {0, 0, 0, 1}}};
}
ros2::msg::String text(int i) { return {std::string(static_cast<std::size_t>(i % 7), 'x')}; }

/// Alternating messages of two topics, ten in a chunk.
Ros1Bag made(const std::string& compression, int messages) {
  Ros1Bag bag(compression);
  bag.topic(0, "/mocap", "geometry_msgs/PoseStamped", support::ros1::kPoseStamped);
  bag.topic(7, "/text", "std_msgs/String", "string data\n");
  for (int i = 0; i < messages; ++i) {
    if (i > 0 && i % kPerChunk == 0) bag.end_chunk();
    if (i % 2 == 0)
      bag.message(0, kStart_ns + i, Ros1Message::encode(pose(i)));
    else
      bag.message(7, kStart_ns + i, Ros1Message::encode(text(i)));
  }
  return bag;
}

std::vector<std::string> expected(int messages) {
  std::vector<std::string> all;
  for (int i = 0; i < messages; ++i)
    all.push_back(made_bags::shown(i % 2 == 0 ? "/mocap" : "/text", kStart_ns + i,
                                   i % 2 == 0 ? ros2::encode(pose(i)) : ros2::encode(text(i))));
  return all;
}

class Ros1Bags : public ::testing::Test {
 protected:
  fs::path holding(ByteView file) const {
    save(folder_.path() / "x.bag", file);
    return folder_.path() / "x.bag";
  }
  made_bags::Seen seen(ByteView file) const { return made_bags::read(holding(file)); }

  const test::TemporaryFolder folder_;
};

TEST_F(Ros1Bags, AreReadWhateverTheirCompression) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    SCOPED_TRACE(compression);
    Ros1Bag bag = made(compression, 35);
    const fs::path path = holding(bag.closed());
    EXPECT_TRUE(is_bag(path));
    const made_bags::Seen found = made_bags::read(path);
    EXPECT_EQ(found.messages, expected(35));
    EXPECT_FALSE(found.report.truncated || found.report.damaged);
    EXPECT_TRUE(found.report.warnings.empty());
    ASSERT_EQ(found.report.topics.size(), 2U);
    EXPECT_EQ(found.report.topics[0],
              (BagTopic{"/mocap", "geometry_msgs/msg/PoseStamped", "cdr", 18, kStart_ns, kStart_ns + 34}));
    EXPECT_EQ(found.report.topics[1].type, "std_msgs/msg/String");
    EXPECT_EQ(read_bag(path).topics, found.report.topics) << "counted without reading";
  }
}

TEST_F(Ros1Bags, PackedAsAWholeAreReadToo) {
  EXPECT_EQ(seen(compress_zstd(made("lz4", 35).closed())).messages, expected(35));
}

TEST_F(Ros1Bags, NeedNoIndex) {
  Ros1Bag bag = made("bz2", 35);
  const Bytes whole = bag.closed();
  for (const std::size_t size : {bag.index_at(), bag.index_at() + 5, bag.index_at() + 200}) {
    const made_bags::Seen found = seen(ByteView(whole).first(size));
    EXPECT_EQ(found.messages, expected(35));
    EXPECT_FALSE(found.report.damaged);
    EXPECT_TRUE(found.report.truncated);
  }
}

TEST_F(Ros1Bags, ThatAreCutAreReadUpToThere) {
  for (const char* compression : {"none", "lz4"}) {
    Ros1Bag bag = made(compression, 50);
    const Bytes whole = bag.closed();
    std::size_t most = 0;
    for (std::size_t size = 4200; size < bag.index_at(); size += 37) {
      const made_bags::Seen found = seen(ByteView(whole).first(size));
      EXPECT_TRUE(found.report.truncated) << size;
      EXPECT_FALSE(found.report.damaged) << size;
      most = std::max(most, found.messages.size());
      EXPECT_GE(found.messages.size() + kPerChunk, most);
      EXPECT_EQ(found.messages, expected(static_cast<int>(found.messages.size()))) << size;
      if (compression == std::string("lz4")) {
        EXPECT_EQ(found.messages.size() % kPerChunk, 0U) << "a chunk that was cut is left out";
      }
    }
    EXPECT_GE(most, 40U);
  }
}

TEST_F(Ros1Bags, OfAKilledRecorderAreReadUpToTheLastMessage) {
  const made_bags::Seen plain = seen(made("none", 35).killed());
  EXPECT_EQ(plain.messages, expected(35));
  EXPECT_TRUE(plain.report.truncated);
  EXPECT_FALSE(plain.report.damaged);
  const made_bags::Seen packed = seen(made("bz2", 35).killed());
  EXPECT_EQ(packed.messages, expected(30)) << "the open chunk cannot be expanded";
  EXPECT_TRUE(packed.report.truncated);
  EXPECT_FALSE(packed.report.damaged);
}

TEST_F(Ros1Bags, DamageInsideAChunkCostsTheRestOfThatChunk) {
  Ros1Bag bag = made("none", 35);
  Bytes file = bag.closed();
  const std::string_view bytes = as_text(file);
  const std::size_t second = bytes.find("compression", bytes.find("compression") + 1);
  const std::size_t message = bytes.find("time=", second);
  store(std::span(file), message + 5 + 8, std::uint32_t{0xFFFFFF});  // the length of its data
  const made_bags::Seen found = seen(file);
  EXPECT_TRUE(found.report.damaged);
  EXPECT_EQ(found.messages.size(), 25U);
}

TEST_F(Ros1Bags, MessagesThatDoNotFitTheirDefinitionAreLeftOut) {
  Ros1Bag bag;
  bag.topic(1, "/n", "std_msgs/Int32", "int32 data\n");
  bag.message(1, 5, Bytes{1, 0, 0, 0});
  bag.message(1, 6, Bytes{1, 0, 0});
  bag.message(1, 7, Bytes{1, 0, 0, 0, 0});
  bag.message(1, 8, Bytes{0x28, 0xB5, 0x2F, 0xFD});  // as zstd begins
  const made_bags::Seen found = seen(bag.closed());
  EXPECT_EQ(found.messages.size(), 2U);
  EXPECT_TRUE(found.report.damaged);
  EXPECT_THAT(found.report.warnings, testing::Each(support::Tells(BagDamage::message_against_definition)));
  EXPECT_EQ(found.report.topics.at(0).messages, 4U);
}

TEST_F(Ros1Bags, TypesThatAreNotDefinedStayAsTheyAre) {
  Ros1Bag bag;
  bag.topic(1, "/n", "p/T", "unknown/Type a\n");
  bag.message(1, 5, Bytes{1, 2, 3});
  const made_bags::Seen found = seen(bag.closed());
  EXPECT_EQ(found.messages, std::vector{made_bags::shown("/n", 5, Bytes{1, 2, 3})});
  EXPECT_EQ(found.report.topics.at(0), (BagTopic{"/n", "p/msg/T", "ros1", 1, 5, 5}));
}

TEST_F(Ros1Bags, OfOtherVersionsAreRefused) {
  const fs::path path = holding(as_bytes("#ROSBAG V1.2\n"));
  EXPECT_THAT([&] { read_bag(path); }, ThrowsTelling(BagProblem::old_version, path.string(), "1.2"));
}

/// A conversion keeps the messages of ROS 1 as they are.
TEST_F(Ros1Bags, InMcapAreReadToo) {
  Bytes file;
  McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros1", "test"});
  const auto channel = writer.add_channel(
      writer.add_schema("geometry_msgs/PoseStamped", "ros1msg", support::ros1::kPoseStamped), "/mocap",
      "ros1", {});
  for (int i = 0; i < 4; i += 2)
    writer.write(channel, static_cast<std::uint64_t>(kStart_ns + i), Ros1Message::encode(pose(i)));
  writer.close();
  const made_bags::Seen found = seen(file);
  EXPECT_EQ(found.messages, (std::vector{expected(3)[0], expected(3)[2]}));
  EXPECT_EQ(found.report.topics.at(0).type, "geometry_msgs/msg/PoseStamped");
  EXPECT_EQ(found.report.topics.size(), 1U);
}

TEST_F(Ros1Bags, LayoutsComeWithTheTopicsOfAllStorages) {
  const auto layout_in = [](const fs::path& path) { return read_bag(path).topics.at(0).layout; };
  EXPECT_TRUE(layout_in(holding(made("none", 1).closed())));
  Bytes file;
  McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"});
  writer.write(writer.add_channel(writer.add_schema("p/msg/T", "ros2msg", "int8 a\n"), "/t", "cdr", {}), 1,
               Bytes{0, 1, 0, 0, 1});
  writer.close();
  EXPECT_TRUE(layout_in(holding(file)));
  {
    const Database database = made_bags::open(folder_.path() / "x.db3");
    made_bags::run(database,
                   made_bags::schema(4) +
                       "INSERT INTO message_definitions VALUES(1,'p/msg/A','ros2msg','int8 a','RIHS01'),"
                       "(2,'p/msg/B','ros2idl','module','RIHS01');");
  }
  EXPECT_TRUE(layout_in(folder_.path() / "x.db3"));
  EXPECT_FALSE(read_bag(folder_.path() / "x.db3").topics.at(1).layout) << "IDL is not read";
}

TEST_F(Ros1Bags, ThatClaimMoreThanTheyHoldStayWithinTheLimits) {
  for (const char* compression : {"bz2", "lz4"}) {
    Ros1Bag bag(compression);
    bag.topic(1, "/n", "std_msgs/Int32", "int32 data\n");
    const Bytes bomb = bag.pack(Bytes(std::size_t{31} << 20));
    for (int i = 0; i < 10; ++i)
      bag.add_chunk(bomb, std::uint32_t{31} << 20, static_cast<std::uint32_t>(bomb.size()));
    bag.add_chunk(bomb, 0xFFFFFFFF, static_cast<std::uint32_t>(bomb.size()));
    const fs::path path = holding(bag.closed());
    const Taken taken = measured([&] {
      const BagReport report = read_bag(path);
      EXPECT_TRUE(report.damaged);
    });
    EXPECT_EQ(taken.complaint, "");
    EXPECT_BOUNDED(taken, static_cast<std::size_t>(fs::file_size(path)));
  }
}

TEST_F(Ros1Bags, RandomDamageNeverHarmsTheReader) {
  constexpr unsigned kSeed = 20261126;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  for (const char* compression : {"none", "bz2", "lz4"}) {
    const Bytes seed = made(compression, 60).closed();
    const Taken taken = measured([&] {
      support::Mutator mutator(kSeed);
      for (int round = 0; round < 400; ++round) {
        const fs::path path = holding(mutator.bytes(seed));
        try {
          made_bags::read(path);
        } catch (const Error& error) {
          if (error.values().empty() || error.values().front() != path.string())
            throw std::runtime_error(std::string("the error does not name the file: ") + error.what());
        }
      }
    });
    EXPECT_TRUE(taken.ended);
    EXPECT_EQ(taken.complaint, "");
    if (support::kMeasuresMemory) {
      EXPECT_LE(taken.peak_bytes, 4 * seed.size() + (std::size_t{64} << 20));
    }
  }
}

}  // namespace
}  // namespace astro::bag
