#include "common/base/byte_ring.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>
#include <thread>
#include <vector>

namespace astro {
namespace {

TEST(ByteRing, TakesWhatFitsAndNoMore) {
  ByteRing<8> ring;
  const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_EQ(ring.room(), 8U);
  EXPECT_EQ(ring.push(bytes), 8U);
  EXPECT_EQ(ring.room(), 0U);
  EXPECT_EQ(ring.push(bytes), 0U);
  std::vector<std::uint8_t> into(20, 0xEE);
  EXPECT_EQ(ring.pop(into), 8U);
  EXPECT_EQ(into[7], 8);
  EXPECT_EQ(into[8], 0xEE) << "touches nothing beyond";
  EXPECT_EQ(ring.size(), 0U);
}

TEST(ByteRing, BehavesLikeAnUnboundedQueueThatRefusesWhatIsTooMuch) {
  constexpr unsigned kSeed = 8;
  std::mt19937 random(kSeed);
  ByteRing<32> ring;
  std::deque<std::uint8_t> model;
  std::uint8_t next = 0;
  for (int step = 0; step < 100'000; ++step) {
    std::vector<std::uint8_t> bytes(random() % 40);
    if (random() % 2 == 0) {
      for (std::uint8_t& byte : bytes) byte = next++;
      const std::size_t taken = ring.push(bytes);
      ASSERT_EQ(taken, std::min(bytes.size(), 32 - model.size())) << "seed " << kSeed;
      model.insert(model.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(taken));
    } else {
      const std::size_t moved = ring.pop(bytes);
      ASSERT_EQ(moved, std::min(bytes.size(), model.size())) << "seed " << kSeed;
      for (std::size_t i = 0; i < moved; ++i, model.pop_front()) ASSERT_EQ(bytes[i], model.front());
    }
    ASSERT_EQ(ring.size(), model.size());
  }
}

TEST(ByteRing, LosesAndRepeatsNothingBetweenAWriterAndAReaderAtOnce) {
  constexpr std::uint32_t kBytes = 200'000;
  ByteRing<64> ring;
  std::thread writer([&] {
    for (std::uint32_t sent = 0; sent < kBytes;) {
      const auto byte = static_cast<std::uint8_t>(sent * 7);
      if (ring.push(std::span(&byte, 1)) == 1) {
        ++sent;
      } else {
        std::this_thread::yield();
      }
    }
  });
  std::uint32_t received = 0, wrong = 0;
  std::array<std::uint8_t, 16> into{};
  while (received < kBytes) {
    const std::size_t count = ring.pop(into);
    for (std::size_t i = 0; i < count; ++i, ++received)
      wrong += into[i] != static_cast<std::uint8_t>(received * 7) ? 1 : 0;
    if (count == 0) std::this_thread::yield();
  }
  writer.join();
  EXPECT_EQ(wrong, 0U);
}

}  // namespace
}  // namespace astro
