#include "host/live/dds/rtps_parameters.hpp"

#include <gmock/gmock.h>

#include "tests/support/ros2/rtps_samples.hpp"

namespace astro::dds {
namespace {

using support::words;
using testing::Eq;
using testing::Optional;

constexpr auto kLittle = std::endian::little;
constexpr std::uint16_t kSentinel = 1, kTopic = 0x05, kLease = 0x02, kPartition = 0x29, kUserData = 0x2c,
                        kLocator = 0x2f, kParticipant = 0x50, kProperties = 0x59, kKeyHash = 0x70,
                        kOfVendor = 0x8007, kUndefined = 0x0fff;

Bytes parameter(std::uint16_t id, const Bytes& value) {
  Bytes bytes;
  append(bytes, id);
  append(bytes, static_cast<std::uint16_t>(value.size()));
  append(bytes, ByteView(value));
  return bytes;
}

/// Whether a list of this parameter is well-formed.
bool accepts(std::uint16_t id, const Bytes& value) {
  Bytes list = parameter(id, value);
  append(list, ByteView(parameter(kSentinel, {})));
  return parameter_list_size(list, kLittle) == list.size();
}

TEST(ParameterList, EndsWithItsSentinel) {
  Bytes list = parameter(kUndefined, words({7, 8}));
  append(list, ByteView(parameter(kSentinel, {})));
  append(list, std::uint32_t{99});
  EXPECT_THAT(parameter_list_size(list, kLittle), Optional(Eq(16U)));
  for (std::size_t size = 0; size < 16; ++size)
    EXPECT_EQ(parameter_list_size(ByteView(list).first(size), kLittle), std::nullopt) << size;
}

TEST(ParameterList, EndsWithItsSentinelWhateverTheLengthOfThat) {
  EXPECT_THAT(parameter_list_size(words({0xffff'0000 | kSentinel}), kLittle), Optional(Eq(4U)));
}

TEST(ParameterList, IsReadInItsByteOrder) {
  const Bytes list{0, kKeyHash, 0, 16, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, kSentinel, 0, 0};
  EXPECT_THAT(parameter_list_size(list, std::endian::big), Optional(list.size()));
  EXPECT_EQ(parameter_list_size(list, kLittle), std::nullopt);
}

TEST(ParameterList, HasParametersThatBeginAtMultiplesOfFourBytes) {
  EXPECT_TRUE(accepts(kUndefined, Bytes(8)));
  EXPECT_FALSE(accepts(kUndefined, Bytes(6)));
}

TEST(Parameter, IsAsLongAsItsValue) {
  const std::pair<std::uint16_t, std::size_t> sizes[] = {{kLease, 8},    {kLocator, 24}, {kParticipant, 16},
                                                         {kKeyHash, 16}, {0x15, 4},      {0x1a, 12},
                                                         {0x1e, 28},     {0x800f, 24}};
  for (const auto& [id, size] : sizes) {
    EXPECT_TRUE(accepts(id, Bytes(size))) << id;
    EXPECT_FALSE(accepts(id, Bytes(size - 4))) << id;
  }
  EXPECT_TRUE(accepts(kOfVendor, {})) << "nobody but the vendor knows";
  EXPECT_TRUE(accepts(kUndefined, {}));
}

TEST(Parameter, HoldsItsTextOrBytes) {
  for (const std::uint16_t id : {kTopic, kUserData}) {
    EXPECT_TRUE(accepts(id, words({4, 0})));
    EXPECT_TRUE(accepts(id, words({3, 0})));
    EXPECT_FALSE(accepts(id, words({5, 0})));
    EXPECT_FALSE(accepts(id, words({0xffff'ffff, 0})));
    EXPECT_FALSE(accepts(id, {}));
  }
}

TEST(Parameter, HoldsAllItsTexts) {
  const Bytes two = words({2, 3, 0, 1, 0});
  EXPECT_TRUE(accepts(kPartition, two));
  EXPECT_FALSE(accepts(kPartition, words({3, 3, 0, 1, 0})));
  EXPECT_FALSE(accepts(kPartition, words({2, 3, 0, 5, 0})));
  EXPECT_TRUE(accepts(kProperties, words({1, 3, 0, 1, 0})));
  EXPECT_FALSE(accepts(kProperties, two)) << "a property is a name and a value";
  EXPECT_FALSE(accepts(kProperties, words({0xffff'ffff})));
}

TEST(Parameter, HoldsAllItsNumbers) {
  constexpr std::uint16_t kRepresentations = 0x73;
  EXPECT_TRUE(accepts(kRepresentations, words({2, 0})));
  EXPECT_FALSE(accepts(kRepresentations, words({3, 0})));
  EXPECT_FALSE(accepts(kRepresentations, words({0xffff'ffff, 0})));
}

TEST(Parameter, HoldsAllPropertiesOfItsToken) {
  for (const std::uint16_t id : {std::uint16_t{0x1001}, std::uint16_t{0x1002}}) {
    EXPECT_TRUE(accepts(id, words({1, 0, 0, 0})));
    EXPECT_TRUE(accepts(id, words({1, 0, 1, 1, 0, 1, 0, 0})));
    EXPECT_FALSE(accepts(id, words({1, 0, 0xffff'ffff, 0})));
    EXPECT_FALSE(accepts(id, words({1, 0, 0, 1})));
    EXPECT_FALSE(accepts(id, words({1, 0, 0})));
  }
}

TEST(ParameterListPayload, IsAListAndNothingBehindIt) {
  const Bytes little = words({0x300, kSentinel}), big{0, 2, 0, 0, 0, kSentinel, 0, 0};
  EXPECT_TRUE(is_parameter_list_payload(little));
  EXPECT_TRUE(is_parameter_list_payload(big));
  EXPECT_FALSE(is_parameter_list_payload(words({0x300, kSentinel, 0})));
  EXPECT_FALSE(is_parameter_list_payload(words({0x300})));
  EXPECT_FALSE(is_parameter_list_payload(words({0x100, kSentinel}))) << "CDR";
  EXPECT_FALSE(is_parameter_list_payload(words({0x301, kSentinel})));
  EXPECT_FALSE(is_parameter_list_payload(Bytes{0, 3, 0}));
}

}  // namespace
}  // namespace astro::dds
