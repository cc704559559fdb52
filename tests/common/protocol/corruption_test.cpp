#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"

/// Damage on the line. A CRC-32 finds every burst of up to 32 bits and up to 3 flipped bits of a body this
/// short, but one flipped bit in a COBS code byte changes several bytes of the body, and of such damage one
/// in 2^32 passes. So "none of a million" is what to expect with probability 0.9998, and with these seeds it
/// is a fact.
namespace astro::protocol {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::uint32_t kSeed = 2;

struct Damage {
  Framer framer;
  std::uint64_t tried = 0;
  std::uint64_t accepted = 0;

  /// Feeds damaged bytes, then the zero with which the next frame's sender begins.
  void feed(const Bytes& bytes) {
    ++tried;
    for (const std::uint8_t byte : bytes) accepted += framer.push(byte) ? 1 : 0;
    accepted += framer.push(0) ? 1 : 0;
  }
  void expect_all_refused(std::uint64_t at_least) const {
    std::cout << accepted << " of " << tried << " damaged frames accepted, seed " << kSeed << "\n";
    EXPECT_GE(tried, at_least);
    EXPECT_EQ(accepted, 0U);
  }
};

Bytes random_frame(std::mt19937& random) {
  Bytes body(kHeaderSize + random() % 100);
  for (auto& byte : body) byte = static_cast<std::uint8_t>(random() % 3 == 0 ? 0 : random());
  std::array<std::uint8_t, kMaxFrame> out{};
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(encode_frame(body, out))};
}

void flip(Bytes& bytes, std::size_t bit) { bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8)); }

TEST(Corruption, EverySingleBitFlipIsRefused) {
  std::mt19937 random(kSeed);
  Damage damage;
  while (damage.tried < 400'000) {
    Bytes frame = random_frame(random);
    for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
      flip(frame, bit);
      damage.feed(frame);
      flip(frame, bit);
    }
  }
  damage.expect_all_refused(400'000);
}

TEST(Corruption, EveryDoubleBitFlipIsRefused) {
  std::mt19937 random(kSeed);
  Damage damage;
  while (damage.tried < 400'000) {
    const Bytes frame = random_frame(random);
    for (int i = 0; i < 100; ++i) {
      Bytes damaged = frame;
      flip(damaged, random() % (8 * frame.size()));
      flip(damaged, random() % (8 * frame.size()));
      if (damaged != frame) damage.feed(damaged);
    }
  }
  damage.expect_all_refused(400'000);
}

TEST(Corruption, EveryTruncationIsRefused) {
  std::mt19937 random(kSeed);
  Damage damage;
  while (damage.tried < 100'000) {
    const Bytes frame = random_frame(random);
    const std::size_t code_size = frame.size() - 1;
    for (std::size_t kept = 1; kept < code_size; ++kept) {
      damage.feed(Bytes(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(kept)));
      damage.feed(Bytes(frame.begin() + static_cast<std::ptrdiff_t>(kept), frame.end()));
    }
  }
  damage.expect_all_refused(100'000);
}

TEST(Corruption, LostDoubledAndReplacedBytesAreRefused) {
  std::mt19937 random(kSeed);
  Damage damage;
  while (damage.tried < 300'000) {
    const Bytes frame = random_frame(random);
    for (std::size_t i = 0; i + 1 < frame.size(); ++i) {
      const auto at = static_cast<std::ptrdiff_t>(i);
      Bytes lost = frame;
      lost.erase(lost.begin() + at);
      Bytes doubled = frame;
      doubled.insert(doubled.begin() + at, frame[i]);
      Bytes replaced = frame;
      replaced[i] = static_cast<std::uint8_t>(frame[i] + 1 + random() % 255);
      damage.feed(lost);
      damage.feed(doubled);
      damage.feed(replaced);
    }
  }
  damage.expect_all_refused(300'000);
}

TEST(Corruption, TwoFramesRunTogetherAreRefused) {
  std::mt19937 random(kSeed);
  Damage damage;
  while (damage.tried < 50'000) {
    Bytes joined = random_frame(random);
    joined.pop_back();
    const Bytes second = random_frame(random);
    joined.insert(joined.end(), second.begin(), second.end());
    damage.feed(joined);
  }
  damage.expect_all_refused(50'000);
}

}  // namespace
}  // namespace astro::protocol
