#include "hal/i2c/gyro.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

namespace astro::i2c {
namespace {

using State = hal::GyroReading::State;

/// A bus whose transfers take as many calls as a test says, with the registers of one chip.
class FakeBus {
 public:
  void begin_read(std::uint8_t address, std::uint8_t from, std::uint8_t count) noexcept {
    begin(address);
    read.clear();
    for (int i = 0; i < count; ++i) read.push_back(byte_at(static_cast<std::uint8_t>(from + i)));
    count_ = count;
  }
  void begin_write(std::uint8_t address, std::uint8_t number, std::uint8_t value) noexcept {
    begin(address);
    fails_now_ = written.size() == fails_at;
    written.push_back({number, value});
    if (number == bank_register && there_ && (!fails_now_ || heard_though_it_fails)) bank = value;
  }
  Transfer advance() noexcept {
    if (hangs && !releasing) return Transfer::busy;
    if (--calls_left_ > 0) return Transfer::busy;
    if (releasing) {
      releasing = false;
      return hangs ? Transfer::lost : Transfer::done;
    }
    if (std::exchange(fails_now_, false)) return Transfer::lost;
    return there_ ? answer : Transfer::refused;
  }
  std::span<const std::uint8_t> bytes() const noexcept { return {read.data(), count_}; }
  void release() noexcept {
    ++releases;
    releasing = true;
    calls_left_ = 22;
  }

  std::uint8_t chip = 0;  // its address; 0: none
  std::map<std::uint8_t, std::uint8_t> registers;
  std::vector<std::pair<std::uint8_t, std::uint8_t>> written;
  std::vector<std::uint8_t> asked;  // addresses
  Transfer answer = Transfer::done;
  int calls = 2, releases = 0;
  bool hangs = false, releasing = false;
  std::uint8_t bank_register = 0;      // 0: no banks
  std::uint8_t bank = 0;               // the registers are those of bank 0, in any other all read 0
  std::size_t fails_at = SIZE_MAX;     // this write is lost, the first is 0
  bool heard_though_it_fails = false;  // by the chip
  std::vector<std::uint8_t> read;

 private:
  std::uint8_t byte_at(std::uint8_t number) {
    if (bank_register != 0 && number == bank_register) return bank;
    return bank == 0 ? registers[number] : std::uint8_t{0};
  }
  void begin(std::uint8_t address) {
    asked.push_back(address);
    there_ = address == chip;
    calls_left_ = calls;
  }
  int calls_left_ = 0;
  std::size_t count_ = 0;
  bool there_ = false, fails_now_ = false;
};
static_assert(Bus<FakeBus>);

struct Rig {
  FakeBus bus;
  Gyro<FakeBus> gyro{bus};
  hal::GyroReading reading;

  const hal::GyroReading& run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      ++tick;
      if (moves) bus.registers[moving] = static_cast<std::uint8_t>(tick % 199);
      reading = gyro.read();
    }
    return reading;
  }
  unsigned tick = 0;
  bool moves = true;
  std::uint8_t moving = 0x06;  // the lower byte of Z, here of the FXAS21002C
};

void plug_fxas(FakeBus& bus) {
  bus.chip = 0x20;
  bus.registers = {{0x0C, 0xD7}, {0x01, 0x01}, {0x02, 0x02}, {0x03, 0xFF}, {0x04, 0xFE}};
}

TEST(I2cGyro, IsFoundByItsIdentityAtEitherAddressAndStartedFromItsTable) {
  Rig rig;
  plug_fxas(rig.bus);
  EXPECT_EQ(rig.run(300).state, State::running);
  EXPECT_EQ(rig.reading.rate[0], 0x0102);
  EXPECT_EQ(rig.reading.rate[1], -2);
  EXPECT_EQ(rig.reading.count_nradps, 272'708U) << "500 / 32000 degrees a second";
  ASSERT_EQ(rig.bus.written.size(), gyro_chips::kFxas21002c.size());
  for (std::size_t i = 0; i < rig.bus.written.size(); ++i)
    EXPECT_EQ(rig.bus.written[i],
              (std::pair{gyro_chips::kFxas21002c[i].number, gyro_chips::kFxas21002c[i].value}));
}

void plug_icm(Rig& rig) {
  rig.bus.chip = 0x68;
  rig.bus.bank_register = 0x7F;
  rig.moving = 0x38;
  rig.bus.registers = {{0x00, 0xEA}, {0x33, 0x01}, {0x34, 0x02}, {0x35, 0xFF}, {0x36, 0xFE}};
}

TEST(I2cGyro, AStartThatFailsAtAnyOfItsSettingsSucceedsLater) {
  for (const bool heard : {false, true})
    for (std::size_t at = 0; at < gyro_chips::kIcm20948.size(); ++at) {
      Rig rig;
      plug_icm(rig);
      rig.bus.fails_at = at;
      rig.bus.heard_though_it_fails = heard;
      EXPECT_EQ(rig.run(3000).state, State::running) << at << ' ' << heard;
      EXPECT_EQ(rig.reading.rate[0], 0x0102);
      EXPECT_EQ(rig.bus.releases, 1) << at;
    }
}

TEST(I2cGyro, AChipThatARestartHasLeftInAnotherBankIsFound) {
  Rig rig;
  plug_icm(rig);
  rig.bus.bank = 0x20;
  EXPECT_EQ(rig.run(2000).state, State::running);
}

TEST(I2cGyro, AStrangerThatLooksLikeAChipInThatBankIsToldBankZeroOnceASearchAtMost) {
  Rig rig;
  rig.bus.chip = 0x68;
  rig.bus.registers = {{0x7F, 0x20}};
  EXPECT_EQ(rig.run(3000).state, State::absent);
  for (const auto& write : rig.bus.written)
    EXPECT_EQ(write, (std::pair<std::uint8_t, std::uint8_t>{0x7F, 0}));
  EXPECT_LE(rig.bus.written.size(), 3U);
}

TEST(I2cGyro, TheTemperatureComesWithTheRatesWhereItLiesBesideThem) {
  Rig rig;
  rig.bus.chip = 0x69;
  rig.bus.registers = {{0x75, 0x68}, {0x41, 0xF2}, {0x42, 0x86}, {0x44, 0x01}};  // -3450; X
  rig.run(300);
  EXPECT_EQ(rig.reading.state, State::running);
  EXPECT_NEAR(rig.reading.temperature_cC, (-3450 / 340.0 + 36.53) * 100, 1.01);
}

TEST(I2cGyro, SamplesComeEveryFiveTicksHoweverLongATransferTakesUpToThree) {
  for (const int calls : {1, 2, 3}) {
    Rig rig;
    plug_fxas(rig.bus);
    rig.bus.calls = calls;
    rig.run(300);
    const auto ticks_to_next = [&rig] {
      const std::uint32_t last = rig.reading.number;
      int ticks = 0;
      for (; rig.reading.number == last && ticks < 10; ++ticks) rig.run(1);
      EXPECT_EQ(rig.reading.number, last + 1);
      return ticks;
    };
    ticks_to_next();
    for (int i = 0; i < 20; ++i) EXPECT_EQ(ticks_to_next(), 5) << calls;
  }
}

TEST(I2cGyro, AStrangerAtItsAddressIsOnlyRead) {
  Rig rig;
  rig.bus.chip = 0x68;
  rig.bus.registers = {{0x75, 0x12}};
  EXPECT_EQ(rig.run(3000).state, State::absent);
  EXPECT_TRUE(rig.bus.written.empty());
}

TEST(I2cGyro, WithoutOneEachAddressIsAskedOnceASecond) {
  Rig rig;
  EXPECT_EQ(rig.run(10'000).state, State::absent);
  EXPECT_NEAR(static_cast<double>(rig.bus.asked.size()), 60, 6);
  EXPECT_EQ(rig.bus.releases, 0);
}

TEST(I2cGyro, OneSampleThatFailsIsLeftOutAndFourInARowAreAFailure) {
  Rig rig;
  plug_fxas(rig.bus);
  rig.run(300);
  rig.bus.answer = Transfer::refused;
  rig.run(5);
  rig.bus.answer = Transfer::done;
  EXPECT_EQ(rig.run(10).state, State::running);
  rig.bus.answer = Transfer::refused;
  EXPECT_EQ(rig.run(30).state, State::failed);
  rig.bus.answer = Transfer::done;
  EXPECT_EQ(rig.run(1500).state, State::running) << "found again";
}

TEST(I2cGyro, ASampleThatIsLostCostsNoMoreThanItsReleaseAndFourInARowAreAFailure) {
  Rig rig;
  plug_fxas(rig.bus);
  rig.run(300);
  const auto lose_one = [&rig] {
    const int before = rig.bus.releases;
    rig.bus.answer = Transfer::lost;
    for (int tick = 0; tick < 10 && rig.bus.releases == before; ++tick) rig.run(1);
    rig.bus.answer = Transfer::done;
    return rig.bus.releases == before + 1;
  };
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(lose_one());
    const std::uint32_t last = rig.reading.number;
    EXPECT_EQ(rig.run(22 + 5).state, State::running) << i;
    EXPECT_NE(rig.reading.number, last) << "22 ticks of the release, and a sample: " << i;
  }
  EXPECT_EQ(rig.bus.written.size(), gyro_chips::kFxas21002c.size()) << "not started again";
  rig.bus.answer = Transfer::lost;
  EXPECT_EQ(rig.run(4 * (22 + 5)).state, State::failed);
  rig.bus.answer = Transfer::done;
  EXPECT_EQ(rig.run(1500).state, State::running) << "found again";
}

TEST(I2cGyro, ASampleThatIsLostAtLinesThatStayHeldIsAFailure) {
  Rig rig;
  plug_fxas(rig.bus);
  rig.run(300);
  rig.bus.answer = Transfer::lost;
  for (int tick = 0; tick < 10 && rig.bus.releases == 0; ++tick) rig.run(1);
  rig.bus.answer = Transfer::done;
  rig.bus.hangs = true;
  EXPECT_EQ(rig.run(22).state, State::failed);
  rig.bus.hangs = false;
  EXPECT_EQ(rig.run(1500).state, State::running) << "found again";
}

TEST(I2cGyro, HalfASampleIsNoSample) {
  Rig rig;
  plug_fxas(rig.bus);
  rig.run(300);
  const auto before = rig.reading.rate;
  for (const int gone : {3, 4, 5, 6, 7}) rig.bus.registers[static_cast<std::uint8_t>(gone)] = 0xFF;
  rig.moves = false;
  rig.run(12);
  EXPECT_EQ(rig.reading.rate[1], before[1]);
  EXPECT_EQ(rig.run(100).state, State::failed);
}

TEST(I2cGyro, AChipThatWasResetWhileItTurnsIsToldWithinTheMissesAndNoneOfItsZerosIsASample) {
  Rig rig;
  plug_fxas(rig.bus);
  rig.run(300);
  const auto measures = rig.bus.registers;
  const std::size_t once = rig.bus.written.size();
  rig.bus.registers = {{0x0C, 0xD7}};  // in standby
  rig.moves = false;
  const std::uint32_t last = rig.reading.number;
  rig.run(25);
  EXPECT_EQ(rig.reading.state, State::failed) << "four misses, of five ticks each";
  EXPECT_LE(rig.reading.number, last + 1) << "the one that was under way at most";
  EXPECT_EQ(rig.reading.rate[1], -2);
  for (int tick = 0; tick < 1500 && rig.bus.written.size() < 2 * once; ++tick) {
    rig.run(1);
    EXPECT_EQ(rig.reading.rate[1], -2);
  }
  ASSERT_EQ(rig.bus.written.size(), 2 * once) << "started again";
  rig.bus.registers = measures;
  rig.moves = true;
  EXPECT_EQ(rig.run(200).state, State::running);
}

TEST(I2cGyro, ASampleOfZerosIsLeftOutAndNoFailure) {
  Rig rig;
  plug_fxas(rig.bus);
  rig.run(300);
  const auto measures = rig.bus.registers;
  rig.bus.registers = {{0x0C, 0xD7}};
  rig.moves = false;
  rig.run(10);
  rig.bus.registers = measures;
  rig.moves = true;
  EXPECT_EQ(rig.run(100).state, State::running) << "noise happens to be 0 about all axes now and then";
  EXPECT_EQ(rig.bus.written.size(), gyro_chips::kFxas21002c.size()) << "not started again";
}

TEST(I2cGyro, OneThatRepeatsItselfIsStartedAgain) {
  Rig rig;
  plug_fxas(rig.bus);
  rig.run(300);
  const std::size_t once = rig.bus.written.size();
  rig.moves = false;
  EXPECT_EQ(rig.run(150).state, State::running);
  EXPECT_EQ(rig.run(100).state, State::failed);
  rig.moves = true;
  EXPECT_EQ(rig.run(1500).state, State::running);
  EXPECT_EQ(rig.bus.written.size(), 2 * once);
}

TEST(I2cGyro, ABusThatHangsIsReleasedAndTheSearchBeginsAnew) {
  for (const bool at_start : {true, false}) {
    Rig rig;
    plug_fxas(rig.bus);
    if (!at_start) rig.run(300);
    rig.bus.hangs = true;
    EXPECT_EQ(rig.run(200).state, at_start ? State::absent : State::failed);
    rig.run(5000);
    EXPECT_GE(rig.bus.releases, 4) << "tried again each second";
    EXPECT_LE(rig.bus.releases, 6);
    rig.bus.hangs = false;
    EXPECT_EQ(rig.run(3000).state, State::running);
  }
}

}  // namespace
}  // namespace astro::i2c
