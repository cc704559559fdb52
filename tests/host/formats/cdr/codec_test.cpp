#include "host/formats/cdr/codec.hpp"

#include <gmock/gmock.h>

#include <random>

#include "tests/host/formats/messages/messages.hpp"

namespace astro::ros2 {
namespace {

constexpr unsigned kCodecSeed = 20261124;

/// A value at random, whatever its type.
class AnyValue {
 public:
  explicit AnyValue(unsigned seed) : random_(seed) {}

  template <class T>
  void fill(T& value) {
    if constexpr (Message<T>) {
      for_each_field(value, [&](std::string_view, auto& field) { fill(field); });
    } else if constexpr (std::is_same_v<T, bool>) {
      value = random_() % 2 == 0;
    } else if constexpr (std::is_same_v<T, std::byte>) {
      value = static_cast<std::byte>(random_());
    } else if constexpr (std::is_floating_point_v<T>) {
      value = std::uniform_real_distribution<T>(-1000, 1000)(random_);
    } else if constexpr (Number<T>) {
      value = static_cast<T>(random_());
    } else if constexpr (std::is_same_v<T, std::string>) {
      value.assign(random_() % 20, static_cast<char>('a' + random_() % 26));
    } else if constexpr (IsBoundedText<T>::value) {
      fill(value.text);
    } else if constexpr (IsArray<T>::value) {
      for (auto& each : value) fill(each);
    } else if constexpr (IsOptional<T>::value) {
      if (random_() % 2 == 0) fill(value.emplace());
    } else {
      for (std::size_t i = random_() % 4; i > 0; --i) {
        typename T::value_type each{};
        fill(each);
        value.push_back(each);
      }
    }
  }

 private:
  std::mt19937_64 random_;
};

TEST(Codec, WhatIsEncodedIsDecodedAgainForEachMessage) {
  AnyValue any(kCodecSeed);
  for_each_message([&]<class M>(const M&) {
    for (int i = 0; i < 20; ++i) {
      M message{};
      any.fill(message);
      const Bytes bytes = encode(message);
      EXPECT_GE(bytes.size(), kCdrHeaderBytes + least_bytes<M>()) << M::kType;
      EXPECT_EQ(decode<M>(bytes), message) << M::kType << " seed " << kCodecSeed;
    }
  });
}

TEST(Codec, AMessageThatIsCutAnywhereIsRefused) {
  AnyValue any(kCodecSeed);
  for_each_message([&]<class M>(const M&) {
    if constexpr (!kIsEmpty<M>) {
      M message{};
      any.fill(message);
      const Bytes bytes = encode(message);
      for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decode<M>(ByteView(bytes).first(size))) << M::kType << " at " << size;
    }
  });
}

TEST(Codec, DamagedBytesAreReadWithinThemselvesAndTakeLittleMemory) {
  AnyValue any(kCodecSeed);
  std::mt19937_64 random(kCodecSeed);
  for_each_message([&]<class M>(const M&) {
    M message{};
    any.fill(message);
    const Bytes whole = encode(message);
    for (int i = 0; i < 200; ++i) {
      Bytes bytes = whole;
      for (int k = 0; k < 3 && bytes.size() > 4; ++k)
        bytes[4 + random() % (bytes.size() - 4)] = static_cast<std::uint8_t>(random());
      const auto read = decode<M>(bytes);
      EXPECT_LE(read ? encode(*read).size() : 0, 2 * bytes.size() + 16) << M::kType;
    }
  });
}

TEST(Codec, NumbersAreAlignedFromTheEndOfTheHeader) {
  const msg::Header header{{1, 2}, "ab"};
  EXPECT_EQ(encode(header), (Bytes{0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 'a', 'b', 0}));
  const msg::SetParametersResult result{true, "x"};
  EXPECT_EQ(encode(result), (Bytes{0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 'x', 0}));
}

TEST(Codec, AnEmptyMessageIsOneByteAndNoneWillDo) {
  EXPECT_EQ(encode(msg::Trigger::Request{}), (Bytes{0, 1, 0, 0, 0}));
  EXPECT_TRUE(decode<msg::Trigger::Request>(Bytes{0, 1, 0, 0}));
  EXPECT_FALSE(decode<msg::Trigger::Request>(Bytes{0, 1}));
}

TEST(Codec, AnOdometryWithTheUsualFramesHas724Bytes) {
  msg::Odometry odometry;
  odometry.header.frame_id = "odom";
  odometry.child_frame_id = "base_link";
  EXPECT_EQ(encode(odometry).size(), 724U);
}

TEST(Codec, BoundsAreKept) {
  msg::NodeEntitiesInfo<16> node;
  node.node_name.text.assign(256, 'n');
  EXPECT_TRUE(decode<msg::NodeEntitiesInfo<16>>(encode(node)));
  node.node_name.text.push_back('n');
  EXPECT_FALSE(decode<msg::NodeEntitiesInfo<16>>(encode(node)));

  CdrWriter two;  // ranges, of which a descriptor has at most one
  put(two, std::string("name"));
  two.number(std::uint8_t{3});
  for (int i = 0; i < 2; ++i) put(two, std::string());
  for (int i = 0; i < 2; ++i) two.number(std::uint8_t{0});
  two.number(std::uint32_t{2});
  for (int i = 0; i < 9; ++i) two.number(0.0);
  EXPECT_FALSE(decode<msg::ParameterDescriptor>(two.bytes()));
}

TEST(Codec, ALengthThatTheMessageCannotHoldTakesNoMemory) {
  CdrWriter out;
  out.number(std::uint32_t{0xFFFFFFFF});
  EXPECT_FALSE(decode<msg::TFMessage>(out.bytes()));
  EXPECT_FALSE(decode<msg::GetParameterTypes::Response>(out.bytes()));
}

TEST(Codec, AMessageBehindOtherFieldsIsAlignedWithThem) {
  CdrWriter out;  // as a request of rmw_cyclonedds begins
  out.number(std::uint64_t{7});
  out.number(std::int64_t{8});
  put(out, msg::SetBool::Request{true});
  const Bytes bytes = out.bytes();
  CdrReader in(bytes);
  EXPECT_EQ(in.number<std::uint64_t>(), 7U);
  EXPECT_EQ(in.number<std::int64_t>(), 8);
  msg::SetBool::Request request;
  take(in, request);
  EXPECT_TRUE(in.ok());
  EXPECT_TRUE(request.data);
}

}  // namespace
}  // namespace astro::ros2
