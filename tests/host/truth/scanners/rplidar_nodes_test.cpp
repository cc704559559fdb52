#include "host/truth/scanners/rplidar_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "host/truth/scanners/rplidar_turns.hpp"

namespace astro::truth::rplidar {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kQ6 = kDegree / 64;  // a unit of an angle

/// Turns of evenly spaced measurements, whose ranges all differ and fit every form.
std::vector<Node> measured(int turns, int per_turn) {
  std::vector<Node> nodes;
  for (int i = 0; i < turns * per_turn; ++i)
    nodes.push_back({2 * std::numbers::pi * (i % per_turn) / per_turn,
                     i % 7 == 3 ? 0.0 : 0.2 + 0.001 * (i % 5000), i, i % per_turn == 0});
  return nodes;
}

Bytes stream_of(AnswerType type, const std::vector<Node>& nodes) {
  Bytes bytes;
  if (type == AnswerType::nodes) {
    for (const Node& node : nodes) append(bytes, node_bytes(node));
    return bytes;
  }
  const std::size_t size = nodes_of(type);
  for (std::size_t i = 0; i + size <= nodes.size(); i += size)
    append(bytes, capsule_bytes(type, std::span(nodes).subspan(i, size), i == 0));
  return bytes;
}

void expect_same(const Node& read, const Node& sent) {
  EXPECT_NEAR(std::remainder(read.angle_rad - sent.angle_rad, 2 * std::numbers::pi), 0, kQ6);
  EXPECT_NEAR(read.range_m, sent.range_m, 1e-9);
  EXPECT_EQ(read.count, sent.count);
}

class RplidarNodes : public testing::TestWithParam<AnswerType> {};
INSTANTIATE_TEST_SUITE_P(Forms, RplidarNodes,
                         testing::Values(AnswerType::nodes, AnswerType::capsules, AnswerType::dense_capsules),
                         [](const auto& test) {
                           return test.param == AnswerType::nodes      ? "Nodes"
                                  : test.param == AnswerType::capsules ? "Capsules"
                                                                       : "DenseCapsules";
                         });

TEST_P(RplidarNodes, ComeBackAsTheyWereHoweverTheBytesAreCut) {
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  const std::vector<Node> sent = measured(4, 360);
  const Bytes stream = stream_of(GetParam(), sent);
  for (const std::size_t longest : {1U, 3U, 64U, 100'000U}) {
    NodeReader reader(GetParam());
    std::vector<Node> read;
    for (std::size_t at = 0; at < stream.size();) {
      const std::size_t count = std::min(stream.size() - at, 1 + random() % longest);
      for (const Node& node : reader.take(ByteView(stream).subspan(at, count))) read.push_back(node);
      at += count;
    }
    ASSERT_GE(read.size() + 2 * nodes_of(GetParam()),
              sent.size());  // the last capsule waits for its successor
    EXPECT_EQ(reader.skipped_bytes(), 0);
    for (std::size_t i = 0; i < read.size(); ++i) {
      expect_same(read[i], sent[i]);
      EXPECT_EQ(read[i].follows, i != 0);
      EXPECT_EQ(read[i].starts_turn, sent[i].starts_turn && (i > 0 || GetParam() == AnswerType::nodes)) << i;
    }
  }
}

/// What was read is what was sent, in order, with gaps.
void expect_a_part_of(const std::vector<Node>& read, const std::vector<Node>& sent) {
  std::size_t at = 0;
  for (const Node& node : read) {
    while (at < sent.size() &&
           (std::abs(sent[at].range_m - node.range_m) > 1e-6 ||
            std::abs(std::remainder(sent[at].angle_rad - node.angle_rad, 2 * std::numbers::pi)) > kQ6))
      ++at;
    ASSERT_LT(at, sent.size()) << "a measurement that nobody sent";
    ++at;
  }
}

TEST_P(RplidarNodes, AfterLostBytesAreInStepAgainAndSayThatSomethingIsMissing) {
  const std::vector<Node> sent = measured(12, 360);
  const Bytes whole = stream_of(GetParam(), sent);
  for (std::size_t lost = 1; lost <= 4; ++lost) {
    Bytes stream = whole;
    const auto at = static_cast<std::ptrdiff_t>(stream.size() / 2 + 1);
    stream.erase(stream.begin() + at, stream.begin() + at + static_cast<std::ptrdiff_t>(lost));
    NodeReader reader(GetParam());
    const std::vector<Node> read = reader.take(stream);
    EXPECT_GT(reader.skipped_bytes(), 0);
    EXPECT_GT(read.size() + 4 * nodes_of(GetParam()), sent.size());  // at most three capsules are gone
    EXPECT_EQ(std::ranges::count(read, false, &Node::follows), 2);   // the first, and the one behind the gap
    // A measurement that lost a byte may take one of the next, so one may be wrong where the step was lost.
    const auto gap =
        std::ranges::find_if(read.begin() + 1, read.end(), [](const Node& node) { return !node.follows; });
    expect_a_part_of({gap, read.end()}, sent);
  }
}

TEST_P(RplidarNodes, AreNotFoundInNoise) {
  constexpr unsigned kSeed = 9;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  Bytes noise(200'000);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
  NodeReader reader(GetParam());
  // Six nodes in a row pass by chance once in 6^6 = 47,000 bytes, and a believed one is soon found out: a dozen at most.
  EXPECT_LT(reader.take(noise).size(), 120U);
  EXPECT_GT(reader.skipped_bytes(), 198'000);
}

TEST(RplidarCapsules, SpreadTheirAnglesUpToTheNextOneAndTakeTheCompensationOff) {
  std::vector<Node> nodes(64);
  for (std::size_t i = 0; i < 64; ++i)
    nodes[i] = {(350 + 0.5 * static_cast<double>(i)) * kDegree, 1, 0, false};
  for (Node& node : nodes) node.angle_rad = std::fmod(node.angle_rad, 2 * std::numbers::pi);
  Bytes first = capsule_bytes(AnswerType::capsules, std::span(nodes).first(32), true);
  // The first measurement of the first pair: 2.5 degrees are 20 eighths, 0b010100: the upper two bits stand below the range.
  first[4] = static_cast<std::uint8_t>(first[4] | 0b01U);
  first[8] = static_cast<std::uint8_t>(first[8] | 0b0100U);
  std::uint8_t sum = 0;
  for (std::size_t i = 2; i < first.size(); ++i) sum = static_cast<std::uint8_t>(sum ^ first[i]);
  first[0] = static_cast<std::uint8_t>(0xA0U | (sum & 0xFU));
  first[1] = static_cast<std::uint8_t>(0x50U | sum >> 4U);
  append(first, capsule_bytes(AnswerType::capsules, std::span(nodes).subspan(32), false));
  const std::vector<Node> read = NodeReader(AnswerType::capsules).take(first);
  ASSERT_EQ(read.size(), 32U);
  EXPECT_NEAR(read[0].angle_rad, 347.5 * kDegree, 1e-9);
  EXPECT_NEAR(read[1].angle_rad, 350.5 * kDegree, 1e-9);
  EXPECT_NEAR(read[20].angle_rad, 0, 1e-9);
  EXPECT_TRUE(read[20].starts_turn);
  EXPECT_EQ(std::ranges::count(read, true, &Node::starts_turn), 1);
}

TEST(RplidarNodes5, HaveTheBytesOfTheMakersNotes) {
  // Quality 47 and the start flag; 90 degrees are 5760 sixty-fourths, beside the constant bit; 1 m is 4000 quarters of a mm.
  EXPECT_EQ(node_bytes({90 * kDegree, 1, 0, true}), (Bytes{0xBD, 0x01, 0x2D, 0xA0, 0x0F}));
}

TEST(SampleClock, FindsTheRateOfAScannerThatIsFasterOrSlowerThanItSays) {
  constexpr double kSaid_s = 500e-6;
  for (const double ratio : {0.8, 0.88, 1.0, 1.12, 1.2}) {
    SampleClock clock(kSaid_s);
    for (int ms = 1; ms <= 3000; ++ms) {
      const auto count = static_cast<std::int64_t>(1e-3 * ms / (ratio * kSaid_s));
      clock.arrived(count, std::chrono::milliseconds(ms));
      if (ms % 180 == 0 && clock.settled()) clock.update();  // about once a turn
    }
    EXPECT_TRUE(clock.settled()) << ratio;
    EXPECT_NEAR(clock.period_s(), ratio * kSaid_s, 1e-7) << "within a count of one in thousands";
  }
}

}  // namespace
}  // namespace astro::truth::rplidar
