#include <gmock/gmock.h>

#include <ctime>

#include "host/base/error.hpp"
#include "host/formats/files/bag_damage.hpp"
#include "tests/host/formats/files/made_bags.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/mutations.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

// Bags that claim more than they hold, or lead SQLite astray, stay within the limits of bounded.hpp.
namespace astro::bag {
namespace {

using namespace made_bags;  // NOLINT(google-build-using-namespace): its names are about bags alone
using astro::support::measured;
using astro::support::Taken;
using astro::support::Tells;
using astro::support::ThrowsTelling;

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

class HostileBag : public ::testing::Test {
 protected:
  fs::path at(const std::string& name) const { return folder_.path() / name; }

  void make_database(const std::string& sql) const {
    fs::remove(at("x.db3"));
    run(open(at("x.db3")), sql);
  }
  /// Reading ends with this error.
  template <class Matcher>
  static void expect_refused(const fs::path& path, const Matcher& error) {
    const Taken taken = measured([&] { EXPECT_THAT([&] { read(path); }, error); });
    EXPECT_BOUNDED(taken, static_cast<std::size_t>(fs::file_size(path)));
  }
  /// Reading leaves something out, and this is its first warning.
  template <class Matcher>
  static void expect_warned(const fs::path& path, const Matcher& warning) {
    const Taken taken = measured([&] {
      const BagReport report = read(path).report;
      EXPECT_TRUE(report.damaged || report.truncated);
      EXPECT_THAT(report.warnings.at(0), warning);
    });
    EXPECT_EQ(taken.complaint, "");
    EXPECT_BOUNDED(taken, static_cast<std::size_t>(fs::file_size(path)));
  }
  const test::TemporaryFolder folder_;
};

constexpr const char* kTopics =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT,type TEXT,serialization_format TEXT);"
    "INSERT INTO topics VALUES(1,'/a','p/msg/A','cdr');";

TEST_F(HostileBag, AViewWithoutAnEndIsNotRead) {
  make_database(std::string(kTopics) +
                "CREATE VIEW messages AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i+1 FROM n) "
                "SELECT i AS id, 1 AS topic_id, i AS timestamp, x'00' AS data FROM n;");
  expect_refused(at("x.db3"), ThrowsTelling(BagProblem::no_such_table, at("x.db3").string(), "messages"));
}

TEST_F(HostileBag, ComputedColumnsAreRefused) {
  make_database(std::string(kTopics) +
                "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER,timestamp INTEGER,data AS "
                "(zeroblob(500000000)));INSERT INTO messages(topic_id,timestamp) VALUES(1,2);");
  expect_refused(at("x.db3"), ThrowsTelling(BagProblem::computed_columns, at("x.db3").string(), "messages"));
}

TEST_F(HostileBag, VirtualTablesAreRefused) {
  make_database(std::string(kTopics) + "CREATE VIRTUAL TABLE messages USING fts5(topic_id,timestamp,data);");
  expect_refused(at("x.db3"), ThrowsTelling(BagProblem::no_such_table, at("x.db3").string(), "messages"));
}

TEST_F(HostileBag, RowsWithoutTimesOrTopicsAreLeftOut) {
  make_database(schema(1) + "INSERT INTO messages VALUES(1,1,'soon',x'00'),(2,7,1,x'00'),(3,1,2,x'00');");
  expect_warned(at("x.db3"), Tells(BagDamage::message_incomplete, at("x.db3").string()));
}

TEST_F(HostileBag, MoreTopicsThanAnyRobotHasAreLeftOut) {
  make_database(
      schema(1) +
      "WITH RECURSIVE n(i) AS (SELECT 10 UNION ALL SELECT i+1 FROM n LIMIT 100000) INSERT INTO topics "
      "SELECT i,'/t'||i,'t','cdr' FROM n;");
  expect_warned(at("x.db3"), Tells(BagDamage::too_many_topics, at("x.db3").string()));
}

TEST_F(HostileBag, FilesAndMessagesThatExpandToGigabytesAreCutOff) {
  const Bytes packed = compress_zstd(Bytes(256 * kMebibyte));
  save(at("x.db3.zstd"), packed);
  expect_refused(at("x.db3.zstd"), ThrowsTelling(BagProblem::not_a_bag, at("x.db3.zstd").string()));
  {
    const Database database = open(at("x.db3"));
    run(database, schema(4) + "BEGIN");
    const Bytes bomb = compress_zstd(Bytes(31 * kMebibyte));
    for (int i = 0; i < 100; ++i) add(database, 1, i, bomb);
    add(database, 2, 1, packed);
    run(database, "COMMIT");
  }
  expect_warned(at("x.db3"), Tells(BagDamage::message_does_not_expand, at("x.db3").string()));
}

/// Points every page of the messages' tree at the first one, so that a walk over it never ends.
TEST_F(HostileBag, PagesThatLeadRoundInACircleEnd) {
  make_db3(at("x.db3"), 20'000, 0, 100);
  Bytes file = load_file(at("x.db3"));
  constexpr std::size_t kPage = 4096;
  for (std::size_t page = 1; page * kPage < file.size(); ++page) {
    const std::size_t start = page * kPage;
    if (file[start] != 5) continue;  // an interior page of a table
    const std::size_t cells = std::size_t{file[start + 3]} * 256 + file[start + 4];
    for (std::size_t cell = 1; cell < cells; ++cell)
      for (std::size_t byte = 0; byte < 2; ++byte)
        file[start + 12 + 2 * cell + byte] = file[start + 12 + byte];
  }
  save(at("x.db3"), file);
  expect_warned(at("x.db3"), Tells(BagDamage::rows_out_of_order, at("x.db3").string()));
}

/// A journal as it lies beside a database in the middle of a transaction, with the end that SQLite gives one of several
/// databases: the name of a file that it deletes after it was rolled back.
Bytes journal_of_several(const Bytes& journal, const std::string& name) {
  Bytes bytes = journal;
  const auto big_endian = [&](std::uint32_t value) {
    for (const unsigned shift : {24U, 16U, 8U, 0U})
      bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  };
  std::uint32_t sum = 0;
  for (const char c : name) sum += static_cast<std::uint32_t>(c);
  big_endian(0x4000'0000U / 4096 + 1);
  append(bytes, as_bytes(name));
  big_endian(static_cast<std::uint32_t>(name.size()));
  big_endian(sum);
  append(bytes, Bytes{0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7});
  return bytes;
}

TEST_F(HostileBag, AJournalDeletesNoFileOfThisComputer) {
  const fs::path victim = at("thesis.tex");
  save(victim, as_bytes("three years of work"));
  make_db3(at("live.db3"), 200);
  {
    const Database recorder = open(at("live.db3"));
    run(recorder,
        "PRAGMA cache_size=1;BEGIN");  // what does not fit into the cache goes to the disk, behind a journal
    run(recorder, "UPDATE messages SET data = zeroblob(2000)");
    fs::copy_file(at("live.db3"), at("x.db3"));
    save(at("x.db3-journal"), journal_of_several(load_file(at("live.db3-journal")), victim.string()));
  }
  const Seen seen = read(at("x.db3"));
  EXPECT_EQ(seen.messages, expected(200)) << "the transaction is rolled back";
  EXPECT_TRUE(fs::exists(victim));
}

void survives_mutations(const fs::path& path, const Bytes& seed) {
  constexpr unsigned kSeed = 20240613;
  constexpr int kRounds = 1200;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const Taken taken = measured([&] {
    astro::support::Mutator mutator(kSeed);
    for (int round = 0; round < kRounds; ++round) {
      save(path, mutator.bytes(seed));
      const std::clock_t start = std::clock();
      try {
        read(path);
      } catch (const Error& error) {
        if (error.kind() == Kind() || error.values().empty() || error.values().front() != path.string())
          throw std::runtime_error(std::string("the error does not name the file: ") + error.what());
      }
      if (astro::support::kMeasuresMemory && std::clock() - start > CLOCKS_PER_SEC)
        throw std::runtime_error("more than a second for mutation " + std::to_string(round));
    }
  });
  EXPECT_TRUE(taken.ended);
  EXPECT_EQ(taken.complaint, "");
  if (astro::support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, 4 * seed.size() + 64 * kMebibyte);
  }
}

TEST_F(HostileBag, RandomDamageNeverHarmsTheReaderOfDatabases) {
  make_db3(at("seed.db3"), 100, 0, 200);
  survives_mutations(at("x.db3"), load_file(at("seed.db3")));
}

TEST_F(HostileBag, RandomDamageNeverHarmsTheReaderOfMcapBags) {
  survives_mutations(at("x.mcap"), made_mcap(300));
}

TEST_F(HostileBag, RandomDamageNeverHarmsTheReaderOfPackedFiles) {
  survives_mutations(at("x.mcap.zstd"), compress_zstd(made_mcap(300)));
}

}  // namespace
}  // namespace astro::bag
