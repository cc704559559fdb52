#include "host/emulator/robot/gyro_chips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace astro::emulator {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;

}  // namespace

void GyroChip::fail(SensorProblem problem, const char* sentence, std::uint8_t number, std::uint8_t value) {
  machine_.fail({fmt::format("gyro, register 0x{:02X}, value 0x{:02X}: {}", number, value, sentence),
                 problem,
                 {fmt::format("0x{:02X}", number), fmt::format("0x{:02X}", value)}});
}

bool GyroChip::addressed(std::uint8_t address, bool reads) {
  if (address != address_ || fault == SensorFault::unplugged || starting()) return false;
  expects_number_ = !reads;
  bytes_read_ = 0;
  if (reads && fault != SensorFault::frozen) sample();
  return true;
}

bool GyroChip::write(std::uint8_t byte) {
  if (expects_number_) {
    number_ = byte;
    expects_number_ = false;
    return true;
  }
  const std::uint8_t number = number_;
  number_ = next(number_);
  return set(number, byte);
}

std::uint8_t GyroChip::read() {
  constexpr int kHalf = 3;
  const std::uint8_t number = number_;
  number_ = next(number_);
  if (fault == SensorFault::half_sample && bytes_read_++ >= kHalf) return 0xFF;
  const std::uint8_t byte = get(number);
  return fault == SensorFault::wrong_id && number == id_register() ? static_cast<std::uint8_t>(byte ^ 0x11)
                                                                   : byte;
}

std::uint8_t GyroChip::rate_byte(std::size_t place) const {
  const auto word = static_cast<std::uint16_t>(counts_[place / 2]);
  return static_cast<std::uint8_t>(place % 2 == 0 ? word >> 8 : word);
}

void GyroChip::take_rates(double count_radps) {
  const auto now = rates_();
  for (std::size_t axis = 0; axis < 3; ++axis)
    counts_[axis] =
        static_cast<std::int16_t>(std::lround(std::clamp(now[axis] / count_radps, -32768.0, 32767.0)));
}

// ---- FXAS21002C

void Fxas21002c::power_on() {
  clear_rates();
  control0_ = control1_ = control3_ = 0;
  busy_for_ms(1);
}

bool Fxas21002c::set(std::uint8_t number, std::uint8_t value) {
  constexpr std::uint8_t kReset = 0x40, kMode = 0x03;
  const bool active = (control1_ & kMode) != 0;
  switch (number) {
    case 0x0D:
    case 0x15:
      if (active) fail(SensorProblem::changed_while_active, "may be changed in standby only", number, value);
      (number == 0x0D ? control0_ : control3_) = value;
      return true;
    case 0x13:
      if ((value & kReset) != 0) {
        power_on();
        return false;
      }
      if (active && (value & ~kMode) != (control1_ & ~kMode))
        fail(SensorProblem::changed_while_active, "the rate may be changed in standby only", number, value);
      control1_ = value;
      return true;
    default:
      fail(SensorProblem::unknown_register, "no driver here writes this register", number, value);
      return false;
  }
}

std::uint8_t Fxas21002c::get(std::uint8_t number) {
  if (number >= 0x01 && number <= 0x06) return rate_byte(number - 1U);
  switch (number) {
    case 0x00:
      return 0;  // reading the rates has cleared it
    case 0x0C:
      return 0xD7;
    case 0x0D:
      return control0_;
    case 0x13:
      return control1_;
    case 0x15:
      return control3_;
    default:
      fail(SensorProblem::unknown_register, "no driver here reads this register", number, 0);
      return 0;
  }
}

// After Z come the status, or X again, as CTRL_REG3 says.
std::uint8_t Fxas21002c::next(std::uint8_t number) const {
  if (number == 0x06) return (control3_ & 0x08) != 0 ? 0x01 : 0x00;
  return static_cast<std::uint8_t>(number + 1);
}

void Fxas21002c::sample() {
  const bool active = (control1_ & 0x02) != 0;
  if (!active) return;
  const double range_dps = 2000.0 / (1 << (control0_ & 3));
  take_rates(range_dps / 32000 * kDegree_rad);
}

// ---- MPU-6050

void Mpu6050::power_on() {
  clear_rates();
  power_ = 0x40;
  divider_ = filter_ = range_ = 0;
  busy_for_ms(30);
}

bool Mpu6050::set(std::uint8_t number, std::uint8_t value) {
  switch (number) {
    case 0x6B:
      if ((value & 0x80) != 0)
        power_on();
      else
        power_ = value;
      return true;
    case 0x19:
      divider_ = value;
      return true;
    case 0x1A:
      filter_ = value;
      return true;
    case 0x1B:
      range_ = value;
      return true;
    default:
      fail(SensorProblem::unknown_register, "no driver here writes this register", number, value);
      return false;
  }
}

std::uint8_t Mpu6050::get(std::uint8_t number) {
  if (number >= 0x43 && number <= 0x48) return rate_byte(number - 0x43U);
  switch (number) {
    case 0x41:
      return 0xF2;  // -3450: 26.4 degrees
    case 0x42:
      return 0x86;
    case 0x49:
      return 0;  // of a sensor behind it, which there is none
    case 0x00:
    case 0x7F:
      return 0;  // of other chips the identity and the bank, here something else
    case 0x75:
      return 0x68;
    default:
      fail(SensorProblem::unknown_register, "no driver here reads this register", number, 0);
      return 0;
  }
}

void Mpu6050::sample() {
  const bool asleep = (power_ & 0x40) != 0;
  if (asleep) return;
  take_rates((1 << (range_ >> 3 & 3)) / 131.0 * kDegree_rad);
}

// ---- ICM-20948

void Icm20948::power_on() {
  clear_rates();
  power_ = 0x41;
  bank_ = divider_ = 0;
  range_ = 1;
  busy_for_ms(11);
}

bool Icm20948::set(std::uint8_t number, std::uint8_t value) {
  if (number == 0x7F) {
    bank_ = value >> 4;
  } else if (bank_ == 0 && number == 0x06) {
    if ((value & 0x80) != 0)
      power_on();
    else
      power_ = value;
  } else if (bank_ == 2 && number == 0x00) {
    divider_ = value;
  } else if (bank_ == 2 && number == 0x01) {
    range_ = value;
  } else {
    fail(SensorProblem::unknown_register, "no driver here writes this register", number, value);
  }
  return true;
}

std::uint8_t Icm20948::get(std::uint8_t number) {
  if (bank_ == 0 && number >= 0x33 && number <= 0x38) return rate_byte(number - 0x33U);
  if (bank_ == 0 && number == 0x00) return 0xEA;
  if (bank_ == 0 && number == 0x39) return 0x06;  // 1669: 26 degrees
  if (bank_ == 0 && number == 0x3A) return 0x85;
  if (bank_ == 0 && number == 0x3B) return 0;
  if (bank_ == 2 && number == 0x00) return divider_;
  if (number == 0x75) return 0;  // of another chip the identity, here something else
  if (number == 0x7F) return static_cast<std::uint8_t>(bank_ << 4);
  fail(SensorProblem::unknown_register, "no driver here reads this register", number, bank_);
  return 0;
}

void Icm20948::sample() {
  const bool asleep = (power_ & 0x40) != 0;
  if (asleep || bank_ != 0) return;
  take_rates((1 << (range_ >> 1 & 3)) / 131.0 * kDegree_rad);
}

}  // namespace astro::emulator
