#include "common/protocol/cobs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace astro {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes encoded(const Bytes& data) {
  Bytes out(cobs::max_encoded_size(data.size()));
  out.resize(*cobs::encode(data, out));
  return out;
}

Bytes decoded(const Bytes& code) {
  Bytes out(code.size());
  const auto size = cobs::decode(code, out);
  EXPECT_TRUE(size.ok());
  out.resize(*size);
  return out;
}

Bytes count_up(int first, int last) {
  Bytes bytes(static_cast<std::size_t>(last - first + 1));
  std::iota(bytes.begin(), bytes.end(), static_cast<std::uint8_t>(first));
  return bytes;
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Bytes with many zeros and long runs without any: what COBS has cases for.
rc::Gen<Bytes> awkward_bytes() {
  return rc::gen::map(rc::gen::container<std::vector<Bytes>>(rc::gen::oneOf(
                          rc::gen::just(Bytes{0}), rc::gen::just(Bytes(253, 7)), rc::gen::just(Bytes(254, 8)),
                          rc::gen::just(Bytes(255, 9)), rc::gen::arbitrary<Bytes>())),
                      [](const std::vector<Bytes>& parts) {
                        return std::accumulate(parts.begin(), parts.end(), Bytes{},
                                               [](const Bytes& a, const Bytes& b) { return a + b; });
                      });
}

struct Vector {
  Bytes plain, code;
};

// The examples of the encyclopaedia article "Consistent Overhead Byte Stuffing", which follow the paper; the
// ending zero is left off.
std::vector<Vector> published_vectors() {
  return {
      {{0x00}, {0x01, 0x01}},
      {{0x00, 0x00}, {0x01, 0x01, 0x01}},
      {{0x00, 0x11, 0x00}, {0x01, 0x02, 0x11, 0x01}},
      {{0x11, 0x22, 0x00, 0x33}, {0x03, 0x11, 0x22, 0x02, 0x33}},
      {{0x11, 0x22, 0x33, 0x44}, {0x05, 0x11, 0x22, 0x33, 0x44}},
      {{0x11, 0x00, 0x00, 0x00}, {0x02, 0x11, 0x01, 0x01, 0x01}},
      {count_up(0x01, 0xFE), Bytes{0xFF} + count_up(0x01, 0xFE)},
      {Bytes{0x00} + count_up(0x01, 0xFE), Bytes{0x01, 0xFF} + count_up(0x01, 0xFE)},
      {count_up(0x01, 0xFF), Bytes{0xFF} + count_up(0x01, 0xFE) + Bytes{0x02, 0xFF}},
      {count_up(0x02, 0xFF) + Bytes{0x00}, Bytes{0xFF} + count_up(0x02, 0xFF) + Bytes{0x01, 0x01}},
      {count_up(0x03, 0xFF) + Bytes{0x00, 0x01}, Bytes{0xFE} + count_up(0x03, 0xFF) + Bytes{0x02, 0x01}},
  };
}

TEST(Cobs, EncodesAndDecodesThePublishedVectors) {
  for (const auto& [plain, code] : published_vectors()) {
    EXPECT_EQ(encoded(plain), code);
    EXPECT_EQ(decoded(code), plain);
  }
}

TEST(Cobs, EncodesNothingAsOneByte) {
  EXPECT_EQ(encoded({}), Bytes{0x01});
  EXPECT_EQ(decoded({0x01}), Bytes{});
}

TEST(Cobs, DecodesASuperfluousBlockBehindAFullOne) {
  EXPECT_EQ(decoded(Bytes{0xFF} + count_up(0x01, 0xFE) + Bytes{0x01}), count_up(0x01, 0xFE));
}

TEST(Cobs, NamesWhatIsWrongWithAnEncoding) {
  Bytes out(300);
  EXPECT_EQ(cobs::decode({}, out).error(), cobs::Error::empty);
  EXPECT_EQ(cobs::decode(Bytes{0x00}, out).error(), cobs::Error::zero_inside);
  EXPECT_EQ(cobs::decode(Bytes{0x03, 0x11, 0x00}, out).error(), cobs::Error::zero_inside);
  EXPECT_EQ(cobs::decode(Bytes{0x04, 0x11, 0x22}, out).error(), cobs::Error::cut_short);
}

RC_GTEST_PROP(Cobs, RoundTripsAnyBytesWithoutZerosAndWithinItsBound, ()) {
  const Bytes plain = *awkward_bytes();
  const Bytes code = encoded(plain);
  RC_ASSERT(std::count(code.begin(), code.end(), 0) == 0);
  RC_ASSERT(code.size() > plain.size());
  RC_ASSERT(decoded(code) == plain);
}

TEST(Cobs, NeedsItsWholeBoundForBytesWithoutZeros) {
  for (std::size_t size = 0; size < 1100; ++size) {
    EXPECT_EQ(encoded(Bytes(size, 1)).size(), cobs::max_encoded_size(size));
  }
}

RC_GTEST_PROP(Cobs, DecodesInPlace, ()) {
  const Bytes plain = *awkward_bytes();
  Bytes buffer = encoded(plain);
  buffer.resize(*cobs::decode(buffer, buffer));
  RC_ASSERT(buffer == plain);
}

RC_GTEST_PROP(Cobs, RefusesAnOutputThatIsOneByteTooSmall, ()) {
  const Bytes plain = *awkward_bytes();
  Bytes code = encoded(plain);
  Bytes small(plain.size());
  const std::span<std::uint8_t> out(small);
  RC_ASSERT(cobs::decode(code, out).ok());
  if (!plain.empty())
    RC_ASSERT(cobs::decode(code, out.first(plain.size() - 1)).error() == cobs::Error::no_room);
  RC_ASSERT(cobs::encode(plain, std::span(code).first(cobs::max_encoded_size(plain.size()) - 1)).error() ==
            cobs::Error::no_room);
}

RC_GTEST_PROP(Cobs, DecodesAnyBytesToFewerBytesOrANamedError, (Bytes noise)) {
  Bytes out(noise.size());
  const auto size = cobs::decode(noise, out);
  const bool sound = size.ok() ? *size < noise.size() : !cobs::name(size.error()).empty();
  RC_ASSERT(sound);
}

}  // namespace
}  // namespace astro
