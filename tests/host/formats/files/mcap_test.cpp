#include <gmock/gmock.h>
#include <lz4frame.h>

#include "host/formats/files/compression.hpp"
#include "host/formats/files/mcap_reader.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::bag {
namespace {

using bag::mcap::Op;

/// Writes into memory, with three messages in two channels and one Metadata record.
struct Written {
  Bytes file;
  std::size_t before_close = 0;

  explicit Written(McapWriterOptions options = {}) {
    McapWriter writer([this](ByteView bytes) { append(file, bytes); }, {"ros2", "test"}, options);
    const auto schema = writer.add_schema("a/msg/A", "ros2msg", "int32 a\n");
    const auto a = writer.add_channel(schema, "/a", "cdr", {{"key", "value"}});
    const auto b = writer.add_channel(schema, "/b", "cdr", {});
    writer.write_metadata({"notes", {{"x", "1"}, {"y", ""}}});
    writer.write(a, 10, as_bytes("one"));
    writer.write(b, 30, as_bytes("two"));
    writer.write(a, 20, as_bytes("three"));
    before_close = file.size();
    writer.close();
  }
};

struct Seen {
  McapReport report;
  std::vector<std::string> messages;
  std::vector<bag::mcap::Metadata> metadata;

  explicit Seen(ByteView file) {
    McapHandlers handlers;
    handlers.message = [this](const bag::mcap::Channel& channel, const bag::mcap::Schema* schema,
                              const bag::mcap::Message& message) {
      messages.push_back(channel.topic + ":" + (schema == nullptr ? "-" : schema->name) + ":" +
                         std::to_string(message.sequence) + ":" + std::to_string(message.log_time_ns) + ":" +
                         std::string(as_text(message.data)));
    };
    handlers.metadata = [this](const bag::mcap::Metadata& record) { metadata.push_back(record); };
    report = read_mcap(file, handlers);
  }
};

TEST(Mcap, ReaderSeesWhatTheWriterWrote) {
  const Seen seen(Written().file);
  EXPECT_FALSE(seen.report.truncated || seen.report.damaged);
  EXPECT_TRUE(seen.report.warnings.empty());
  EXPECT_EQ(seen.report.profile, "ros2");
  EXPECT_EQ(seen.messages, (std::vector<std::string>{"/a:a/msg/A:0:10:one", "/b:a/msg/A:0:30:two",
                                                     "/a:a/msg/A:1:20:three"}));
  ASSERT_EQ(seen.metadata.size(), 1U);
  EXPECT_EQ(seen.metadata[0].name, "notes");
  EXPECT_EQ(seen.metadata[0].entries, (bag::mcap::Map{{"x", "1"}, {"y", ""}}));
}

TEST(Mcap, NothingReachesTheSinkBeforeAChunkIsFullAndEverythingAfter) {
  const Written lazy;
  EXPECT_EQ(Seen(ByteView(lazy.file).first(lazy.before_close)).messages.size(), 0U);
  // Chunks of at most 15 ns: the second message is 20 ns after the first and closes one, the third stays
  // open.
  const Written by_time({1 << 20, 15});
  EXPECT_EQ(Seen(ByteView(by_time.file).first(by_time.before_close)).messages.size(), 2U);
  const Written by_size({1, 1'000'000'000});
  EXPECT_EQ(Seen(ByteView(by_size.file).first(by_size.before_close)).messages.size(), 3U);
}

TEST(Mcap, AFileWithoutItsSummaryCountsAsCutOffAndKeepsItsMessages) {
  const Written written({1, 1'000'000'000});
  const Seen seen(ByteView(written.file).first(written.before_close));
  EXPECT_TRUE(seen.report.truncated);
  EXPECT_FALSE(seen.report.damaged);
  EXPECT_EQ(seen.messages.size(), 3U);
  EXPECT_FALSE(seen.report.warnings.empty());
}

TEST(Mcap, AFileWithoutMessagesIsWhole) {
  Bytes file;
  McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"});
  writer.close();
  const Seen seen(file);
  EXPECT_TRUE(seen.report.is_mcap);
  EXPECT_FALSE(seen.report.truncated || seen.report.damaged);
}

Bytes pack_lz4(ByteView bytes) {
  Bytes out(LZ4F_compressFrameBound(bytes.size(), nullptr));
  out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  return out;
}

/// A file of one chunk, assembled by hand.
Bytes file_with_chunk(const bag::mcap::Chunk& chunk) {
  Bytes file(std::begin(bag::mcap::kMagic), std::end(bag::mcap::kMagic));
  bag::mcap::append_record(file, Op::header, bag::mcap::encode(bag::mcap::Header{"", ""}));
  bag::mcap::append_record(file, Op::chunk, bag::mcap::encode(chunk));
  bag::mcap::append_record(file, Op::data_end, Bytes(4));
  bag::mcap::append_record(file, Op::footer, Bytes(20));
  append(file, ByteView(bag::mcap::kMagic));
  return file;
}

Bytes one_message() {
  Bytes records;
  bag::mcap::append_record(records, Op::channel,
                           bag::mcap::encode(bag::mcap::Channel{1, 0, "/t", "json", {}}));
  bag::mcap::append_message(records, {1, 0, 5, 5, as_bytes("hi")});
  return records;
}

TEST(Mcap, ChunksAreReadWhateverTheirCompression) {
  const Bytes records = one_message();
  const std::uint32_t crc = crc32_ieee(records);
  const Bytes zstd = compress_zstd(records);
  const Bytes lz4 = pack_lz4(records);
  for (const bag::mcap::Chunk& chunk : {bag::mcap::Chunk{5, 5, records.size(), crc, "", records},
                                        bag::mcap::Chunk{5, 5, records.size(), crc, "zstd", zstd},
                                        bag::mcap::Chunk{5, 5, records.size(), crc, "lz4", lz4},
                                        bag::mcap::Chunk{5, 5, records.size(), 0, "lz4", lz4}}) {
    const Seen seen(file_with_chunk(chunk));
    EXPECT_EQ(seen.messages, std::vector<std::string>{"/t:-:0:5:hi"}) << chunk.compression;
    EXPECT_FALSE(seen.report.damaged || seen.report.truncated) << chunk.compression;
  }
}

TEST(Mcap, ChunksThatLieAboutThemselvesAreLeftOut) {
  const Bytes records = one_message();
  const std::uint32_t crc = crc32_ieee(records);
  const Bytes zstd = compress_zstd(records);
  const Bytes lz4 = pack_lz4(records);
  const std::uint64_t size = records.size();
  constexpr auto kNotThisSize = McapProblem::chunk_does_not_expand, kTooLarge = McapProblem::chunk_too_large;
  const std::vector<std::pair<bag::mcap::Chunk, McapProblem>> chunks{
      {{5, 5, size, crc + 1, "", records}, McapProblem::wrong_chunk_checksum},
      {{5, 5, size + 1, 0, "", records}, kNotThisSize},
      {{5, 5, size + 1, 0, "zstd", zstd}, kNotThisSize},
      {{5, 5, size - 1, 0, "zstd", zstd}, kNotThisSize},
      {{5, 5, size + 1, 0, "lz4", lz4}, kNotThisSize},
      {{5, 5, size - 1, 0, "lz4", lz4}, kNotThisSize},
      {{5, 5, std::uint64_t{1} << 60, 0, "zstd", zstd}, kTooLarge},
      {{5, 5, std::uint64_t{1} << 27, 0, "lz4", lz4}, kTooLarge},
      {{5, 5, std::uint64_t{1} << 27, 0, "zstd", zstd}, kTooLarge},
      {{5, 5, size, 0, "lz4", zstd}, kNotThisSize},
      {{5, 5, size, 0, "bzip2", records}, kNotThisSize}};
  for (const auto& [chunk, problem] : chunks) {
    const Seen seen(file_with_chunk(chunk));
    EXPECT_TRUE(seen.messages.empty()) << chunk.compression << " " << chunk.size;
    EXPECT_TRUE(seen.report.damaged) << chunk.compression << " " << chunk.size;
    EXPECT_THAT(seen.report.warnings, testing::ElementsAre(support::Tells(problem, "25")))
        << chunk.compression << " " << chunk.size;
  }
}

TEST(Mcap, ChecksumIsThatOfZlib) {
  EXPECT_EQ(crc32_ieee(as_bytes("123456789")), 0xCBF43926U);  // the check value of CRC-32/ISO-HDLC
  EXPECT_EQ(crc32_ieee(as_bytes("56789"), crc32_ieee(as_bytes("1234"))), 0xCBF43926U);
}

TEST(Mcap, UnknownRecordsAndTrailingFieldsAreSkipped) {
  Bytes file(std::begin(bag::mcap::kMagic), std::end(bag::mcap::kMagic));
  Bytes header = bag::mcap::encode(bag::mcap::Header{"p", "l"});
  append(header, as_bytes("a field of the future"));
  bag::mcap::append_record(file, Op::header, header);
  bag::mcap::append_record(file, static_cast<Op>(0x90), as_bytes("private"));
  Bytes channel = bag::mcap::encode(bag::mcap::Channel{1, 0, "/t", "json", {}});
  channel.push_back(1);
  bag::mcap::append_record(file, Op::channel, channel);
  bag::mcap::append_record(file, static_cast<Op>(0x7F), {});
  bag::mcap::append_message(file, {1, 0, 5, 5, as_bytes("hi")});
  bag::mcap::append_record(file, Op::data_end, Bytes(7));
  bag::mcap::append_record(file, Op::footer, Bytes(24));
  append(file, ByteView(bag::mcap::kMagic));
  const Seen seen(file);
  EXPECT_EQ(seen.messages.size(), 1U);
  EXPECT_EQ(seen.report.profile, "p");
  EXPECT_TRUE(seen.report.warnings.empty());
}

}  // namespace
}  // namespace astro::bag
