#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/interface/board.hpp"

/// The gyros that boards know, as data: how one is recognised, started and read.
namespace astro::i2c {

/// A register to write at the start, and how long the chip needs afterwards.
struct Setting {
  std::uint8_t number, value;
  std::uint16_t wait_ms = 0;
  bool may_be_refused = false;  // the chip restarts before it can acknowledge
};

/// All are set to +-500 degrees a second, because a kick is faster than 250, and to a low pass of some 50 Hz with a new value each
/// millisecond or so. So a value is at most a millisecond old whenever it is read, and nobody has to ask whether it is new.
struct GyroChip {
  std::array<std::uint8_t, 2> addresses;  // of which a pin of the chip chooses one
  std::uint8_t id_register;
  std::array<std::uint8_t, 2> ids;
  std::span<const Setting> start;
  /// What is read of a sample. The last byte of it is never 0xFF, which is what the bus reads of a chip that no longer answers.
  std::uint8_t from, count;
  std::uint8_t rate_at;                              // place of x, y and z in it, upper bytes first
  std::uint8_t temperature_at;                       // kNoTemperature: it is not among them
  std::int32_t temperature_16, temperature_zero_cC;  // 0.01 degrees Celsius per count, 2^-16, and at 0
  std::uint32_t count_nradps;
  /// Of a chip whose registers are in banks: what selects one, and the one that its start selects for a while. The identity is in
  /// bank 0 only.
  std::uint8_t bank_register = kNoBanks, start_bank = 0;

  static constexpr std::uint8_t kNoTemperature = 0xFF, kNoBanks = 0xFF;
};

namespace gyro_chips {

constexpr std::uint32_t nradps(double degrees_per_s) {
  return static_cast<std::uint32_t>(degrees_per_s * 1e9 * 3.141592653589793 / 180 + 0.5);
}

/// NXP FXAS21002C. Source: data sheet, revision 2.1.
inline constexpr std::array<Setting, 5> kFxas21002c{{
    {0x13, 0x00, 1},         // CTRL_REG1: standby, in which alone the others may be changed
    {0x13, 0x40, 10, true},  // reset
    {0x0D, 0x82},            // CTRL_REG0: 64 Hz at 800 samples a second, no high pass, +-500 degrees a second
    {0x15, 0x00},            // CTRL_REG3: after Z the status register comes again
    {0x13, 0x02, 100},       // 800 samples a second, active
}};
/// InvenSense MPU-6050. Source: register map, revision 4.2.
inline constexpr std::array<Setting, 5> kMpu6050{{
    {0x6B, 0x80, 100},  // PWR_MGMT_1: reset
    {0x6B, 0x01, 10},   // awake, clocked by a gyro's resonator
    {0x19, 0x00},       // SMPLRT_DIV: 1000 samples a second
    {0x1A, 0x03},       // CONFIG: 42 Hz
    {0x1B, 0x08, 50},   // GYRO_CONFIG: +-500 degrees a second
}};
/// InvenSense ICM-20948. Source: data sheet, revision 1.3.
inline constexpr std::array<Setting, 6> kIcm20948{{
    {0x06, 0x80, 100},  // PWR_MGMT_1: reset, which also selects bank 0
    {0x06, 0x01, 50},   // awake, best clock
    {0x7F, 0x20},       // REG_BANK_SEL: bank 2
    {0x00, 0x00},       // GYRO_SMPLRT_DIV: 1125 samples a second
    {0x01, 0x1B},       // GYRO_CONFIG_1: 51 Hz, +-500 degrees a second
    {0x7F, 0x00, 50},   // bank 0
}};

}  // namespace gyro_chips

inline constexpr std::array<GyroChip, 3> kGyroChips{{
    // X, Y, Z, and then the status, which has just been cleared.
    {{0x21, 0x20},
     0x0C,
     {0xD7, 0xD1},
     gyro_chips::kFxas21002c,
     0x01,
     7,
     0,
     GyroChip::kNoTemperature,
     0,
     0,
     gyro_chips::nradps(500.0 / 32000)},
    // Temperature, X, Y, Z, and the first byte of a sensor behind it, which there is none.
    {{0x68, 0x69},
     0x75,
     {0x68, 0x68},
     gyro_chips::kMpu6050,
     0x41,
     9,
     2,
     0,
     65536 * 100 / 340,
     3653,
     gyro_chips::nradps(1 / 65.5)},
    // X, Y, Z, temperature, and the first byte of a sensor behind it.
    {{0x69, 0x68},
     0x00,
     {0xEA, 0xEA},
     gyro_chips::kIcm20948,
     0x33,
     9,
     0,
     6,
     6553600 * 100 / 33387,
     2100,
     gyro_chips::nradps(1 / 65.5),
     0x7F,
     0x20},
}};

}  // namespace astro::i2c
