#include <gtest/gtest.h>

#include "host/base/error.hpp"
#include "host/truth/files/tracker_file.hpp"
#include "host/truth/floor/inspection.hpp"
#include "tests/host/truth/files/own_recordings.hpp"
#include "tests/support/base/bounded.hpp"
#include "tests/support/base/mutations.hpp"

namespace astro::truth {
namespace {

using namespace test;

/// Reads what it can, and only ever refuses with a sentence.
void read_anything(const std::string& text) {
  try {
    for (const BodyName& body : bodies_in(text, "x")) read_track(text, "x", body.name);
    inspect(text, "x");
  } catch (const Error&) {
  }
}

class Mutations : public testing::TestWithParam<std::string> {};

TEST_P(Mutations, AreReadOrRefusedInBoundedTime) {
  const auto taken = support::measured([] {
    support::Mutator mutator(20'260'804);
    for (int i = 0; i < 1500; ++i) read_anything(mutator.text(GetParam()));
  });
  EXPECT_EQ(taken.complaint, "");
  EXPECT_TRUE(taken.ended);
  if (support::kMeasuresMemory) {
    EXPECT_LE(taken.peak_bytes, std::size_t{64} << 20);
  }
}
INSTANTIATE_TEST_SUITE_P(Recordings, Mutations, testing::Values(kMotive, kVicon, kTum, kEuroc, kPlain));

/// The header of a recording, and one row of it again and again with another number in front.
std::string long_recording(const std::string& head, const std::string& row, std::size_t size) {
  std::string text = head;
  text.reserve(size + 100);
  for (int i = 1; text.size() < size; ++i) text += std::to_string(i) + row;
  return text;
}

TEST(HostileRecordings, ShortRowsTakeNoMoreMemoryThanTheirBound) {
  constexpr std::size_t kSize = std::size_t{16} << 20;
  const std::string head = kMotive.substr(0, kMotive.find("72,0.6"));
  for (const std::string& text :
       {long_recording(head, "\n", kSize), long_recording("", " 0 0 0 0 0 0 1\n", kSize),
        long_recording("t,x,y\n", ",,\n", kSize),
        long_recording(kVicon.substr(0, kVicon.find("11,0")), "\n", kSize)}) {
    const auto taken = support::measured([&] { read_track(text, "x", text[0] == '\xEF' ? "astro" : ""); });
    EXPECT_BOUNDED(taken, text.size());
  }
}

TEST(HostileRecordings, WideHeadersTakeNoMoreMemoryThanTheirBound) {
  constexpr std::size_t kSize = std::size_t{8} << 20;
  const std::string bodies =
      "Format Version,1.23\n,Type" + support::filled(",Rigid Body", kSize) + "\n,Name\n,ID\n,,\nFrame,Time\n";
  const std::string units = "Objects\n100\n" + support::filled(",a:b", kSize) + "\nFrame\n\n";
  for (const std::string& text :
       {support::filled(",", kSize), support::filled("\"", kSize), support::filled("t,x,y,", kSize),
        support::filled("#\n", kSize), support::filled("Objects\n100\n", kSize), bodies, units}) {
    const auto taken = support::measured([&] { read_anything(text); });
    EXPECT_BOUNDED(taken, text.size());
  }
}

}  // namespace
}  // namespace astro::truth
