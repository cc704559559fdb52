#include "host/truth/scanners/rplidar_packets.hpp"

#include <gtest/gtest.h>

namespace astro::truth::rplidar {
namespace {

// The vectors stand in the maker's notes on the protocol.

TEST(RplidarPackets, RequestsHaveTheBytesOfTheMakersNotes) {
  EXPECT_EQ(request(Command::get_info), (Bytes{0xA5, 0x50}));
  EXPECT_EQ(request(Command::get_health), (Bytes{0xA5, 0x52}));
  EXPECT_EQ(request(Command::scan), (Bytes{0xA5, 0x20}));
  EXPECT_EQ(request(Command::stop), (Bytes{0xA5, 0x25}));
  EXPECT_EQ(request(Command::reset), (Bytes{0xA5, 0x40}));
  EXPECT_EQ(request(Command::express_scan, kExpressPayload), (Bytes{0xA5, 0x82, 0x05, 0, 0, 0, 0, 0, 0x22}));
}

TEST(RplidarPackets, DescriptorsHaveTheBytesOfTheMakersNotes) {
  EXPECT_EQ(to_bytes(Descriptor{AnswerType::info, 20, false}), (Bytes{0xA5, 0x5A, 0x14, 0, 0, 0, 0x04}));
  EXPECT_EQ(to_bytes(Descriptor{AnswerType::health, 3, false}), (Bytes{0xA5, 0x5A, 0x03, 0, 0, 0, 0x06}));
  EXPECT_EQ(to_bytes(Descriptor{AnswerType::nodes, 5, true}), (Bytes{0xA5, 0x5A, 0x05, 0, 0, 0x40, 0x81}));
  EXPECT_EQ(to_bytes(Descriptor{AnswerType::capsules, 84, true}),
            (Bytes{0xA5, 0x5A, 0x54, 0, 0, 0x40, 0x82}));
}

TEST(RplidarPackets, ADescriptorIsFoundBehindWhateverCameBefore) {
  const Descriptor descriptor{AnswerType::health, 3, false};
  Bytes bytes{'R', 'P', 0xA5, 0xA5, 0x5A};  // text, and the beginning of another descriptor
  append(bytes, to_bytes(descriptor));
  const auto found = find_descriptor(bytes, AnswerType::health);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->descriptor, descriptor);
  EXPECT_EQ(found->end, bytes.size());
  EXPECT_FALSE(find_descriptor(bytes, AnswerType::info));
  bytes.pop_back();
  EXPECT_FALSE(find_descriptor(bytes, AnswerType::health));
}

TEST(RplidarPackets, AnswersComeBackAsTheyWere) {
  Info info{0x18, 29, 1, 5, {}};
  info.serial = {1, 2, 3};
  EXPECT_EQ(info_in(to_bytes(info)), info);
  EXPECT_EQ(to_bytes(info).size(), Info::kBytes);
  const Health health{HealthStatus::error, 0x8002};
  EXPECT_EQ(health_in(to_bytes(health)), health);
  EXPECT_EQ(to_bytes(health), (Bytes{2, 0x02, 0x80}));
  const SampleTimes times{505, 252};
  EXPECT_EQ(sample_times_in(to_bytes(times)), times);
}

TEST(RplidarPackets, ModelsAreNamedAsTheMakerDoes) {
  EXPECT_EQ(Info{.model = 0x18}.name(), "A1M8");
  EXPECT_EQ(Info{.model = 0x2C}.name(), "A2M12");
  EXPECT_EQ(Info{.model = 0x41}.name(), "C1M1");
  EXPECT_EQ(Info{.model = 0x71}.name(), "model 0x71");
}

TEST(RplidarPackets, RequestsAreTakenOutOfAStreamWithNoiseInIt) {
  Bytes stream{0x00, 0x17};
  append(stream, request(Command::stop));
  Bytes damaged = request(Command::express_scan, kExpressPayload);
  damaged.back() ^= 1;
  append(stream, damaged);
  append(stream, request(Command::express_scan, kExpressPayload));
  stream.push_back(0xA5);  // of a request whose rest has not come
  EXPECT_EQ(take_request(stream), Command::stop);
  EXPECT_EQ(take_request(stream), Command::express_scan);
  EXPECT_EQ(take_request(stream), std::nullopt);
  stream.push_back(static_cast<std::uint8_t>(Command::get_info));
  EXPECT_EQ(take_request(stream), Command::get_info);
}

}  // namespace
}  // namespace astro::truth::rplidar
