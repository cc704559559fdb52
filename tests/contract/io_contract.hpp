#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/contract/rig.hpp"

/// Serial ports and parameter flash, as hal/interface/board.hpp promises them.
namespace astro::contract {

using Bytes = std::vector<std::uint8_t>;

/// Bytes that differ from their neighbours, so that order matters.
inline Bytes pattern(std::size_t size, int start = 0) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
    bytes[i] = static_cast<std::uint8_t>(31U * i + static_cast<unsigned>(start));
  return bytes;
}

template <Rig R>
class IoContract : public testing::Test {
 protected:
  using Board = std::remove_reference_t<decltype(std::declval<R&>().board())>;
  using Ports = std::remove_reference_t<decltype(std::declval<Board&>().ports())>;
  using Flash = std::remove_reference_t<decltype(std::declval<Board&>().flash())>;
  static constexpr std::uint32_t kSectorBytes = Flash::kSectorBytes;
  static constexpr std::uint32_t kGrain = Flash::kProgramBytes;

  auto& ports() { return rig.board().ports(); }
  auto& flash() { return rig.board().flash(); }
  Bytes flash_bytes(std::uint32_t offset, std::size_t size) {
    Bytes bytes(size);
    flash().read(offset, bytes);
    return bytes;
  }
  bool erase_all() {
    bool all = true;
    for (std::uint32_t sector = 0; sector < Flash::kSectors; ++sector) all = flash().erase(sector) && all;
    return all;
  }
  R rig;
};
TYPED_TEST_SUITE_P(IoContract);

TYPED_TEST_P(IoContract, SilentPortReadsNothing) {
  Bytes into(16, 0xEE);
  for (int port = 0; port < TestFixture::Ports::kPorts; ++port) {
    EXPECT_EQ(this->ports().read(port, into), 0U);
    EXPECT_EQ(into, Bytes(16, 0xEE)) << "and touches nothing";
  }
}

TYPED_TEST_P(IoContract, BytesArriveInOrderAndAtMostAsManyAsAskedFor) {
  const Bytes sent = pattern(100);
  ASSERT_TRUE(this->rig.host_send(0, sent));
  this->rig.pass_ms(50);
  Bytes received, into(33);
  for (int calls = 0; calls < 20 && received.size() < sent.size(); ++calls) {
    const std::size_t count = this->ports().read(0, into);
    ASSERT_LE(count, into.size());
    received.insert(received.end(), into.begin(), into.begin() + static_cast<std::ptrdiff_t>(count));
  }
  EXPECT_EQ(received, sent);
}

TYPED_TEST_P(IoContract, PortsDoNotMix) {
  for (int port = 0; port < TestFixture::Ports::kPorts; ++port) {
    ASSERT_TRUE(this->rig.host_send(port, pattern(5, port)));
    ASSERT_EQ(this->ports().write(port, pattern(6, 100 + port)), 6U);
  }
  this->rig.pass_ms(50);
  for (int port = 0; port < TestFixture::Ports::kPorts; ++port) {
    Bytes into(16);
    into.resize(this->ports().read(port, into));
    EXPECT_EQ(into, pattern(5, port));
    EXPECT_EQ(this->rig.host_receive(port), pattern(6, 100 + port));
  }
}

TYPED_TEST_P(IoContract, HostThatDoesNotReadNeverBlocksTheRobot) {
  auto& ports = this->ports();
  const Bytes chunk = pattern(100);
  std::size_t taken = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::size_t room = ports.room(0), count = ports.write(0, chunk);
    ASSERT_EQ(count, std::min(room, chunk.size())) << "write takes what there is room for";
    taken += count;
  }
  EXPECT_LT(taken, 100000U) << "a queue has an end";
  EXPECT_EQ(ports.room(0), 0U);
  EXPECT_EQ(ports.write(0, chunk), 0U);
  EXPECT_EQ(this->rig.host_receive(0).size(), taken) << "what was taken was kept";
  EXPECT_GT(ports.room(0), 0U) << "reading makes room";
}

TYPED_TEST_P(IoContract, FlashIsLargeEnoughForTwoGenerationsOfParametersAndFaults) {
  EXPECT_GE(TestFixture::Flash::kSectors, 4U);
  EXPECT_EQ(this->kSectorBytes % this->kGrain, 0U);
}

TYPED_TEST_P(IoContract, EraseFillsOneSectorAndNoOther) {
  ASSERT_TRUE(this->erase_all());
  ASSERT_TRUE(this->flash().program(0, Bytes(this->kGrain, 0x00)));
  ASSERT_TRUE(this->flash().program(this->kSectorBytes, Bytes(this->kGrain, 0x00)));
  ASSERT_TRUE(this->flash().erase(0));
  EXPECT_EQ(this->flash_bytes(0, this->kSectorBytes), Bytes(this->kSectorBytes, 0xFF));
  EXPECT_EQ(this->flash_bytes(this->kSectorBytes, this->kGrain), Bytes(this->kGrain, 0x00));
}

TYPED_TEST_P(IoContract, ProgramWritesItsBytesAndNoOthers) {
  ASSERT_TRUE(this->erase_all());
  const Bytes written = pattern(3 * this->kGrain, 1);
  const std::uint32_t offset = this->kSectorBytes - 5 * this->kGrain;
  ASSERT_TRUE(this->flash().program(offset, written));
  EXPECT_EQ(this->flash_bytes(offset, written.size()), written);
  EXPECT_EQ(this->flash_bytes(offset - this->kGrain, this->kGrain), Bytes(this->kGrain, 0xFF));
  EXPECT_EQ(this->flash_bytes(offset + 3 * this->kGrain, this->kGrain), Bytes(this->kGrain, 0xFF));
}

TYPED_TEST_P(IoContract, ProgramOnlyClearsBits) {
  ASSERT_TRUE(this->erase_all());
  ASSERT_TRUE(this->flash().program(0, Bytes(this->kGrain, 0x3C)));
  EXPECT_TRUE(this->flash().program(0, Bytes(this->kGrain, 0x1C))) << "clearing more bits reads back";
  EXPECT_FALSE(this->flash().program(0, Bytes(this->kGrain, 0xF0))) << "setting bits does not";
  EXPECT_EQ(this->flash_bytes(0, this->kGrain), Bytes(this->kGrain, 0x1C & 0xF0)) << "old AND new";
}

TYPED_TEST_P(IoContract, WholeSectorCanBeProgrammedAtOnce) {
  ASSERT_TRUE(this->erase_all());
  const Bytes written = pattern(this->kSectorBytes, 7);
  ASSERT_TRUE(this->flash().program(this->kSectorBytes, written));
  EXPECT_EQ(this->flash_bytes(this->kSectorBytes, this->kSectorBytes), written);
}

REGISTER_TYPED_TEST_SUITE_P(IoContract, SilentPortReadsNothing, BytesArriveInOrderAndAtMostAsManyAsAskedFor,
                            PortsDoNotMix, HostThatDoesNotReadNeverBlocksTheRobot,
                            FlashIsLargeEnoughForTwoGenerationsOfParametersAndFaults,
                            EraseFillsOneSectorAndNoOther, ProgramWritesItsBytesAndNoOthers,
                            ProgramOnlyClearsBits, WholeSectorCanBeProgrammedAtOnce);

}  // namespace astro::contract
