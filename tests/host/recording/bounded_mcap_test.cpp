#include <gmock/gmock.h>

#include <fstream>
#include <random>

#include "host/base/byte_source.hpp"
#include "host/formats/files/compression.hpp"
#include "host/formats/files/mcap_reader.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/formats/messages/ros_messages.hpp"
#include "host/recording/recording_problem.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/sample_messages.hpp"
#include "tests/host/recording/support.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/remarks.hpp"

// Recordings that claim far more than they hold are refused within the limits of bounded.hpp.
namespace astro::recording {
namespace {

using astro::support::measured;
using astro::support::Taken;
using astro::support::ThrowsTelling;
using bag::McapProblem;

constexpr std::size_t kMebibyte = std::size_t{1} << 20;

Bytes start_of_file() {
  Bytes file(std::begin(bag::mcap::kMagic), std::end(bag::mcap::kMagic));
  bag::mcap::append_record(file, bag::mcap::Op::header, bag::mcap::encode(bag::mcap::Header{"ros2", "test"}));
  return file;
}

void append_chunk(Bytes& file, ByteView packed, std::uint64_t claimed) {
  bag::mcap::append_record(file, bag::mcap::Op::chunk,
                           bag::mcap::encode(bag::mcap::Chunk{0, 0, claimed, 0, "zstd", packed}));
}

template <class Matcher>
void expect_refused(const Bytes& file, const Matcher& error) {
  const Taken taken = measured([&] { EXPECT_THAT([&] { run_from_bytes(file, "x.mcap"); }, error); });
  EXPECT_BOUNDED(taken, file.size());
}

/// Refused as damaged; `values` follow the name of the file, the first is where the damage shows.
template <class... Values>
void expect_damaged(const Bytes& file, McapProblem problem, Values... values) {
  expect_refused(file, testing::Throws<DamagedRecording>(
                           testing::ResultOf([](const Error& error) { return error.remark(); },
                                             astro::support::Tells(problem, "x.mcap", values...))));
}

/// Where the first record behind start_of_file() lies.
const std::string kFirst = std::to_string(start_of_file().size());

TEST(BoundedMcap, ChunksThatExpandToMegabytesOneAfterTheOtherAreLeftOut) {
  const Bytes packed = bag::compress_zstd(Bytes(32 * kMebibyte));  // a thousand bytes
  Bytes file = start_of_file();
  while (file.size() < kMebibyte) append_chunk(file, packed, 32 * kMebibyte);
  expect_damaged(file, McapProblem::chunk_ends_inside_record, kFirst);
}

TEST(BoundedMcap, AChunkThatClaimsGigabytesIsLeftOutUnexpanded) {
  const Bytes packed = bag::compress_zstd(Bytes(256 * kMebibyte));
  for (const std::uint64_t claimed : {std::uint64_t{256} << 20, std::uint64_t{4} << 30, ~std::uint64_t{0}}) {
    Bytes file = start_of_file();
    for (int i = 0; i < 100; ++i) append_chunk(file, packed, claimed);
    expect_damaged(file, McapProblem::chunk_too_large, kFirst);
  }
}

TEST(BoundedMcap, SchemasAndChannelsThatExpandToMegabytesAreNotKept) {
  Bytes records;
  for (std::uint16_t id = 1; id <= 250; ++id) {
    const bag::mcap::Schema schema{id, "s", "e", std::string(100'000, ' ')};
    bag::mcap::append_record(records, bag::mcap::Op::schema, bag::mcap::encode(schema));
  }
  Bytes file = start_of_file();
  append_chunk(file, bag::compress_zstd(records), records.size());
  expect_damaged(file, McapProblem::too_many_definitions, kFirst);
}

TEST(BoundedMcap, AMillionEndsOfDataAreReadInATimeThatGrowsWithTheFile) {
  Bytes file = start_of_file();
  while (file.size() < 8 * kMebibyte)
    bag::mcap::append_record(file, bag::mcap::Op::data_end, Bytes{1, 2, 3, 4});
  expect_damaged(file, McapProblem::wrong_data_checksum, kFirst);
}

TEST(BoundedMcap, AFileOfAnySizeIsReadPieceByPiece) {
  support::TempFolder folder;
  const std::filesystem::path path = folder / "long.mcap";
  constexpr int kMessages = 48;
  {
    std::ofstream out(path, std::ios::binary);
    bag::McapWriter writer([&](ByteView bytes) { out << as_text(bytes); }, {"ros2", "test"});
    const auto channel = writer.add_channel(writer.add_schema("a/msg/A", "ros2msg", ""), "/a", "cdr", {});
    std::mt19937_64 random(1);  // so that it does not compress
    for (int i = 0; i < kMessages; ++i) {
      Bytes message;
      while (message.size() < 4 * kMebibyte) append(message, std::uint64_t{random()});
      writer.write(channel, static_cast<std::uint64_t>(i), message);
    }
    writer.close();
  }
  const Taken taken = measured([&] {
    FileSource source(path);
    int messages = 0;
    bag::McapHandlers handlers;
    handlers.message = [&](const auto&, const auto*, const auto&) { ++messages; };
    const bag::McapReport report = bag::read_mcap(source, handlers);
    if (messages != kMessages || report.damaged || report.truncated) throw std::runtime_error("not all read");
  });
  EXPECT_TRUE(taken.ended);
  EXPECT_EQ(taken.complaint, "");
  if (astro::support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, 32 * kMebibyte);  // of a file of 192 MiB
  }
}

TEST(BoundedMcap, AMapOfMillionsOfPairsIsRefused) {
  Bytes pairs;
  for (int i = 0; i < 1'000'000; ++i) {
    bag::mcap::append_string(pairs, std::to_string(i));
    bag::mcap::append_string(pairs, "");
  }
  Bytes content;
  bag::mcap::append_string(content, "astrolabe.run");
  append(content, static_cast<std::uint32_t>(pairs.size()));
  append(content, pairs);
  Bytes file = start_of_file();
  bag::mcap::append_record(file, bag::mcap::Op::metadata, content);
  expect_damaged(file, McapProblem::bad_record, kFirst, "metadata");
}

TEST(BoundedMcap, SamplesThatPackFarBetterThanAnyDriveAreRefused) {
  Bytes definitions, message, chunk;
  bag::mcap::append_record(
      definitions, bag::mcap::Op::schema,
      bag::mcap::encode(bag::mcap::Schema{1, std::string(ros2::pose_stamped_type().name), "ros2msg", ""}));
  bag::mcap::append_record(definitions, bag::mcap::Op::channel,
                           bag::mcap::encode(bag::mcap::Channel{1, 1, "/truth", "cdr", {}}));
  const Bytes pose = recording::encode_truth({});
  bag::mcap::append_message(message, {1, 0, 0, 0, pose});
  while (chunk.size() < 12 * kMebibyte) append(chunk, message);  // the same pose a hundred thousand times
  Bytes file = start_of_file();
  append_chunk(file, bag::compress_zstd(definitions), definitions.size());
  const Bytes packed = bag::compress_zstd(chunk);
  for (int i = 0; i < 5; ++i) append_chunk(file, packed, chunk.size());
  expect_refused(file, ThrowsTelling(RecordingProblem::too_many_samples, "x.mcap"));
}

}  // namespace
}  // namespace astro::recording
