#include <gtest/gtest.h>

#include <algorithm>

#include "host/formats/files/mcap_reader.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "tests/support/base/mutations.hpp"

namespace astro::bag {
namespace {

Bytes small_file() {
  Bytes file;
  McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"}, {200, 100});
  const auto schema = writer.add_schema("a/msg/A", "ros2msg", "int32 a\n");
  const auto channel = writer.add_channel(schema, "/a", "cdr", {{"key", "value"}});
  writer.write_metadata({"notes", {{"x", "1"}}});
  for (std::uint64_t i = 0; i < 12; ++i) writer.write(channel, 30 * i, as_bytes(std::to_string(i)));
  writer.close();
  return file;
}

struct Outcome {
  McapReport report;
  std::vector<std::string> messages;
};

Outcome walk(ByteView file) {
  Outcome outcome;
  McapHandlers handlers;
  handlers.message = [&](const bag::mcap::Channel&, const bag::mcap::Schema*,
                         const bag::mcap::Message& message) {
    outcome.messages.emplace_back(as_text(message.data));
  };
  handlers.metadata = [](const bag::mcap::Metadata&) {};
  outcome.report = read_mcap(file, handlers, {std::uint64_t{1} << 24});
  return outcome;
}

TEST(HostileMcap, CutAtEveryByteItKeepsAPrefixAndSaysSo) {
  const Bytes file = small_file();
  const Outcome whole = walk(file);
  ASSERT_EQ(whole.messages.size(), 12U);
  ASSERT_FALSE(whole.report.truncated);
  std::size_t kept = 0;
  for (std::size_t size = 0; size < file.size(); ++size) {
    const Outcome cut = walk(ByteView(file).first(size));
    EXPECT_EQ(cut.report.is_mcap, size >= 8) << size;
    EXPECT_EQ(cut.report.truncated, size >= 8) << size;
    EXPECT_FALSE(cut.report.damaged) << size;
    EXPECT_GE(cut.messages.size(), kept) << size;
    kept = cut.messages.size();
    EXPECT_TRUE(std::equal(cut.messages.begin(), cut.messages.end(), whole.messages.begin())) << size;
  }
  EXPECT_EQ(kept, 12U);
}

TEST(HostileMcap, ATailOfZerosAfterAPowerCutCountsAsCutOff) {
  Bytes file = small_file();
  const std::size_t size = file.size();
  std::fill(file.begin() + static_cast<std::ptrdiff_t>(size / 2), file.end(), std::uint8_t{0});
  const Outcome cut = walk(file);
  EXPECT_TRUE(cut.report.truncated || cut.report.damaged);
  EXPECT_FALSE(cut.messages.empty());
}

TEST(HostileMcap, EverySingleFlippedBitIsNoticed) {
  Bytes file = small_file();
  for (std::size_t at = 0; at < file.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      file[at] = static_cast<std::uint8_t>(file[at] ^ (1 << bit));
      const McapReport report = walk(file).report;
      EXPECT_TRUE(!report.is_mcap || report.damaged || report.truncated) << "byte " << at << " bit " << bit;
      file[at] = static_cast<std::uint8_t>(file[at] ^ (1 << bit));
    }
  }
}

TEST(HostileMcap, RandomDamageNeverHarmsTheReader) {
  constexpr unsigned kSeed = 20240611;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  support::Mutator mutator(kSeed);
  const Bytes file = small_file();
  for (int round = 0; round < 5000; ++round) EXPECT_LE(walk(mutator.bytes(file)).report.warnings.size(), 8U);
}

TEST(HostileMcap, LengthsThatReachPastTheEndAreNotBelieved) {
  for (const std::uint64_t length : {std::uint64_t{1} << 20, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
    Bytes file(std::begin(bag::mcap::kMagic), std::end(bag::mcap::kMagic));
    file.push_back(static_cast<std::uint8_t>(bag::mcap::Op::metadata));
    append(file, length);
    append(file, as_bytes("short"));
    EXPECT_TRUE(walk(file).report.truncated);
  }
  Bytes strings(std::begin(bag::mcap::kMagic), std::end(bag::mcap::kMagic));
  Bytes content;
  append(content, ~std::uint32_t{0});
  bag::mcap::append_record(strings, bag::mcap::Op::metadata, content);
  EXPECT_TRUE(walk(strings).report.damaged);
}

}  // namespace
}  // namespace astro::bag
