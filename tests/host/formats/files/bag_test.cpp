#include "host/formats/files/bag.hpp"

#include <gmock/gmock.h>

#include "host/base/error.hpp"
#include "host/formats/files/bag_damage.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::bag {
namespace {

using namespace made_bags;  // NOLINT(google-build-using-namespace): its names are about bags alone
using support::ThrowsTelling;
using ::testing::ElementsAre;

class Bag : public ::testing::Test {
 protected:
  fs::path at(const std::string& name) const { return folder_.path() / name; }
  const test::TemporaryFolder folder_;
};

std::vector<std::string> whole(const fs::path& path) {
  const Seen seen = read(path);
  EXPECT_FALSE(seen.report.truncated || seen.report.damaged);
  EXPECT_TRUE(seen.report.warnings.empty()) << seen.report.warnings.front().sentence;
  return seen.messages;
}

TEST_F(Bag, EveryVersionOfTheDatabaseReadsTheSame) {
  for (int version = 1; version <= 4; ++version) {
    const fs::path path = at("v" + std::to_string(version) + ".db3");
    {
      const Database database = open(path);
      run(database, schema(version));
      for (int i = 0; i < 10; ++i) add(database, 1 + i % 2, 1000 + i, message(i));
    }
    EXPECT_EQ(whole(path), expected(10)) << version;
  }
}

TEST_F(Bag, BothStoragesReadTheSameAndTellTheTopics) {
  make_db3(at("x.db3"), 9);
  save(at("x.mcap"), made_mcap(9));
  for (const char* name : {"x.db3", "x.mcap"}) {
    const Seen seen = read(at(name));
    EXPECT_EQ(seen.messages, expected(9)) << name;
    EXPECT_THAT(seen.report.topics, ElementsAre(BagTopic{"/a", "p/msg/A", "cdr", 5, 1000, 1008},
                                                BagTopic{"/b", "p/msg/B", "cdr", 4, 1001, 1007}));
    EXPECT_EQ(read_bag(at(name)).topics, seen.report.topics) << "counted without reading";
  }
}

TEST_F(Bag, OnlyWantedTopicsArePassedOnAndAllAreCounted) {
  make_db3(at("x.db3"), 9);
  save(at("x.mcap"), made_mcap(9));
  for (const char* name : {"x.db3", "x.mcap"}) {
    int passed = 0;
    BagHandlers handlers;
    handlers.wants = [](const BagTopic& topic) { return topic.type == "p/msg/B"; };
    handlers.message = [&](const BagTopic& topic, const BagMessage&) {
      passed += topic.name == "/b" ? 1 : 100;
    };
    const BagReport report = read_bag(at(name), handlers);
    EXPECT_EQ(passed, 4);
    EXPECT_EQ(report.topics[0].messages, 5U);
  }
}

TEST_F(Bag, FilesAndMessagesThatAreCompressedReadLikeOthers) {
  make_db3(at("x.db3"), 9);
  save(at("x.db3.zstd"), compress_zstd(load_file(at("x.db3"))));
  save(at("x.mcap.zstd"), compress_zstd(made_mcap(9)));
  const Database database = open(at("packed.db3"));
  run(database, schema(4));
  for (int i = 0; i < 9; ++i) add(database, 1 + i % 2, 1000 + i, compress_zstd(message(i)));
  for (const char* name : {"x.db3.zstd", "x.mcap.zstd", "packed.db3"})
    EXPECT_EQ(whole(at(name)), expected(9)) << name;
}

TEST_F(Bag, ASplitBagReadsInTheOrderOfItsNumbersWithoutMetadata) {
  for (const int part : {0, 1, 2, 10}) make_db3(at("x_" + std::to_string(part) + ".db3"), 3, 3 * part);
  std::vector<std::string> all = expected(9);
  for (const std::string& last : expected(3, 30)) all.push_back(last);
  EXPECT_EQ(whole(folder_.path()), all);
  EXPECT_TRUE(is_bag(folder_.path()));
}

TEST_F(Bag, MetadataTellTheOrderAndNothingOutsideTheFolderIsRead) {
  make_db3(at("late.db3"), 3, 3);
  save(at("early.mcap"), made_mcap(3));
  make_db3(at("other.db3"), 3, 90);
  std::ofstream(at("metadata.yaml"))
      << "rosbag2_bagfile_information:\n  version: 2\n  relative_file_paths:\n"
         "    - ../../etc/early.mcap\n    - old_name/late.db3\n  message_count: 6\n";
  EXPECT_EQ(whole(folder_.path()), expected(6));
}

TEST_F(Bag, AFileThatMetadataNameAndThatIsGoneIsReported) {
  make_db3(at("x_0.db3"), 3);
  std::ofstream(at("metadata.yaml"))
      << "rosbag2_bagfile_information:\n  relative_file_paths: [x_0.db3, x_1.db3]\n";
  const Seen seen = read(folder_.path());
  EXPECT_EQ(seen.messages, expected(3));
  EXPECT_TRUE(seen.report.truncated);
  EXPECT_THAT(seen.report.warnings, ElementsAre(support::Tells(BagDamage::file_not_there,
                                                               at("metadata.yaml").string(), "x_1.db3")));
}

TEST_F(Bag, TheNewestMessagesOfARecorderThatWasKilledAreInItsLog) {
  const Database recorder = open(at("live.db3"));
  run(recorder, "PRAGMA journal_mode=WAL;PRAGMA wal_autocheckpoint=0;" + schema(4));
  for (int i = 0; i < 20; ++i) add(recorder, 1 + i % 2, 1000 + i, message(i));
  const fs::path killed = at("killed.db3");
  fs::copy_file(at("live.db3"), killed);
  fs::copy_file(at("live.db3-wal"), at("killed.db3-wal"));
  const Bytes file = load_file(killed), log = load_file(at("killed.db3-wal"));
  EXPECT_EQ(whole(killed), expected(20));
  EXPECT_EQ(load_file(killed), file);
  EXPECT_EQ(load_file(at("killed.db3-wal")), log);
  EXPECT_FALSE(fs::exists(at("killed.db3-shm")));
}

TEST_F(Bag, ADatabaseThatIsReadIsNotTouched) {
  make_db3(at("odd name?#%.db3"), 9);
  fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(whole(at("odd name?#%.db3")), expected(9));
  fs::permissions(folder_.path(), fs::perms::owner_all);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(Bag, ACutDatabaseReadsUpToTheCutAndSaysSo) {
  make_db3(at("whole.db3"), 400, 0, 100);
  const Bytes file = load_file(at("whole.db3"));
  const std::vector<std::string> all = expected(400, 0, 100);
  std::size_t most = 0;
  for (std::size_t size = 200; size < file.size(); size += 97) {
    save(at("cut.db3"), ByteView(file).first(size));
    try {
      const Seen seen = read(at("cut.db3"));
      EXPECT_TRUE(seen.report.truncated) << size;
      ASSERT_LE(seen.messages.size(), all.size());
      EXPECT_TRUE(std::equal(seen.messages.begin(), seen.messages.end(), all.begin())) << size;
      most = std::max(most, seen.messages.size());
    } catch (const Error& error) {
      const std::string cut = at("cut.db3").string();
      EXPECT_THAT(error.remark(), testing::AnyOf(support::Tells(BagProblem::unreadable_database, cut),
                                                 support::Tells(BagProblem::no_such_table, cut, testing::_)))
          << size;
    }
  }
  EXPECT_GE(most, 300U);
}

TEST_F(Bag, ACutMcapReadsUpToTheCutAndSaysSo) {
  const Bytes file = made_mcap(60);
  const std::vector<std::string> all = expected(60);
  std::size_t last = 0;
  for (std::size_t size = 8; size < file.size(); ++size) {
    save(at("cut.mcap"), ByteView(file).first(size));
    const Seen seen = read(at("cut.mcap"));
    ASSERT_TRUE(seen.report.truncated) << size;
    ASSERT_TRUE(std::equal(seen.messages.begin(), seen.messages.end(), all.begin())) << size;
    ASSERT_GE(seen.messages.size(), last) << size;
    last = seen.messages.size();
  }
  EXPECT_EQ(last, all.size());
}

TEST_F(Bag, WhatIsNoBagIsRefusedByName) {
  save(at("x.csv"), as_bytes("time_s,x_m\n"));
  make_db3(at("x.db3"), 1);
  { run(open(at("other.db3")), "CREATE TABLE songs(id)"); }
  fs::create_directory(at("empty"));
  EXPECT_THAT([&] { read(at("x.csv")); }, ThrowsTelling(BagProblem::not_a_bag, at("x.csv").string()));
  EXPECT_THAT([&] { read(at("other.db3")); },
              ThrowsTelling(BagProblem::no_such_table, at("other.db3").string(), "topics"));
  EXPECT_THAT([&] { read(at("absent")); }, ThrowsTelling(BagProblem::missing, at("absent").string()));
  EXPECT_THAT([&] { read(at("empty")); }, ThrowsTelling(BagProblem::no_files, at("empty").string()));
  EXPECT_FALSE(is_bag(at("x.csv")));
  EXPECT_FALSE(is_bag(at("empty")));
  EXPECT_TRUE(is_bag(at("x.db3")));
}

}  // namespace
}  // namespace astro::bag
