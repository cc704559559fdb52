#include "host/live/dds/fast_transport.hpp"

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastrtps/utils/IPLocator.h>
#include <gmock/gmock.h>

#include "host/live/dds/rtps_check.hpp"
#include "tests/support/ros2/rtps_samples.hpp"

namespace astro::dds {
namespace {

namespace transport = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

Locator_t at(const std::string& address) {
  Locator_t locator;
  IPLocator::setIPv4(locator, address);
  locator.port = 7410;
  return locator;
}

class Sizes : public transport::TransportReceiverInterface {
 public:
  void OnDataReceived(const eprosima::fastrtps::rtps::octet*, std::uint32_t size, const Locator_t&,
                      const Locator_t&) override {
    sum += size;
  }
  std::uint32_t sum = 0;
};

class Transport : public testing::Test {
 protected:
  std::unique_ptr<transport::ChainingTransport> open(bool here_alone) {
    auto* made = gated_udp(here_alone, gate_, acknowledged_)->create_transport();
    std::unique_ptr<transport::ChainingTransport> opened(dynamic_cast<transport::ChainingTransport*>(made));
    EXPECT_TRUE(opened->init());
    return opened;
  }
  Transport() { gate_->open(); }
  /// How much of a datagram from there is read.
  static std::uint32_t size_read(transport::ChainingTransport& transport, const std::string& address,
                                 ByteView datagram) {
    Sizes sizes;
    transport.receive(&sizes, datagram.data(), static_cast<std::uint32_t>(datagram.size()), at("127.0.0.1"),
                      at(address));
    return sizes.sum;
  }
  /// Whether a datagram from there is read.
  static bool reads(transport::ChainingTransport& transport, const std::string& address) {
    return size_read(transport, address, support::bytes_in(support::kCycloneMessage)) != 0;
  }
  static bool writes(transport::ChainingTransport& transport, const std::string& address) {
    Locator_t result;
    return transport.transform_remote_locator(at(address), result);
  }

  std::shared_ptr<Gate> gate_ = std::make_shared<Gate>();
  std::shared_ptr<AcknowledgedBy> acknowledged_ = std::make_shared<AcknowledgedBy>();
};

// 203.0.113.0/24 is for documentation; no interface has such an address.
TEST_F(Transport, AloneItNeitherReadsDatagramsOfOtherComputersNorWritesToThem) {
  const auto alone = open(true);
  EXPECT_TRUE(reads(*alone, "127.0.0.1"));
  EXPECT_TRUE(writes(*alone, "127.0.0.1"));
  EXPECT_FALSE(reads(*alone, "203.0.113.7"));
  EXPECT_FALSE(writes(*alone, "203.0.113.7"));
}

TEST_F(Transport, NothingIsReadBeforeTheGateOpens) {
  gate_ = std::make_shared<Gate>();
  const auto alone = open(true);
  EXPECT_FALSE(reads(*alone, "127.0.0.1"));
  gate_->open();
  EXPECT_TRUE(reads(*alone, "127.0.0.1"));
}

TEST_F(Transport, OfADatagramItReadsThePartThatIsSound) {
  const auto alone = open(true);
  const Bytes gap = support::bytes_in(support::kFastGap);
  const std::size_t sound = sound_part(gap).size();
  ASSERT_LT(sound, gap.size()) << "the statistics at its end";
  EXPECT_EQ(size_read(*alone, "127.0.0.1", gap), sound);
  EXPECT_EQ(size_read(*alone, "127.0.0.1", ByteView(gap).first(gap.size() - 1)), 0U);
}

// Its own group is named in the settings, which come first.
TEST_F(Transport, MulticastAddressesOfOthersAreNotWrittenTo) {
  gate_ = std::make_shared<Gate>();
  const auto wide = open(false);
  EXPECT_TRUE(writes(*wide, "239.255.0.1"));
  gate_->open();
  EXPECT_FALSE(writes(*wide, "239.255.0.1"));
  EXPECT_TRUE(writes(*wide, "203.0.113.7"));
}

TEST_F(Transport, AnAcknowledgementIsNotedIfItIsExpected) {
  const auto alone = open(true);
  const Bytes bytes = support::bytes_in(support::kCycloneAcknowledgements);
  const auto all = acknowledgements_in(bytes);
  ASSERT_FALSE(all.empty());
  size_read(*alone, "127.0.0.1", bytes);
  EXPECT_FALSE(acknowledged_->has(all[0]));
  acknowledged_->expect(all[0]);
  EXPECT_FALSE(acknowledged_->has(all[0]));
  size_read(*alone, "127.0.0.1", bytes);
  EXPECT_TRUE(acknowledged_->has(all[0]));
  acknowledged_->forget(all[0]);
  EXPECT_FALSE(acknowledged_->has(all[0]));
}

// A participant may announce any address; of a kind unlike UDP over IPv4 Fast DDS 2.9 aborts.
TEST_F(Transport, AnAddressOfAnotherKindIsNotOfThisComputer) {
  Locator_t shared_memory = at("127.0.0.1"), result;
  shared_memory.kind = LOCATOR_KIND_SHM;
  for (const bool here_alone : {true, false}) {
    const auto opened = open(here_alone);
    EXPECT_TRUE(opened->is_local_locator(at("127.0.0.1")));
    EXPECT_FALSE(opened->is_local_locator(shared_memory));
    EXPECT_FALSE(opened->is_locator_allowed(shared_memory));
    EXPECT_FALSE(opened->transform_remote_locator(shared_memory, result));
  }
}

TEST_F(Transport, WithTheNetworkItDoesBoth) {
  const auto wide = open(false);
  EXPECT_TRUE(reads(*wide, "127.0.0.1"));
  EXPECT_TRUE(reads(*wide, "203.0.113.7"));
  EXPECT_TRUE(writes(*wide, "203.0.113.7"));
}

}  // namespace
}  // namespace astro::dds
