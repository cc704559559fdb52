#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "host/emulator/chip/lpi2c.hpp"

namespace astro::emulator {

/// What a sensor is told that it would not do. The values are the register's number and what was written.
enum class SensorProblem { unknown_register, changed_while_active, read_only };

/// A fault of a sensor or of its wires.
enum class SensorFault : std::uint8_t {
  none,
  unplugged,    // nobody acknowledges
  wrong_id,     // another chip at the same address
  frozen,       // the values do not change any more
  half_sample,  // it loses its power in the middle of each sample: what follows reads as ones
};

/// A gyro chip at the I2C bus, as its data sheet has it: registers that count up by themselves, a start that takes its time, a
/// scale that a register sets. What a data sheet forbids ends the run.
class GyroChip : public I2cDevice {
 public:
  /// Rates about the chip's axes, rad/s.
  using Rates = std::function<std::array<double, 3>()>;

  bool addressed(std::uint8_t address, bool reads) override;
  bool write(std::uint8_t byte) override;
  std::uint8_t read() override;

  SensorFault fault = SensorFault::none;
  /// The chip loses its power for a moment.
  virtual void power_on() = 0;

 protected:
  GyroChip(Machine& machine, std::uint8_t address, Rates rates)
      : rates_(std::move(rates)), machine_(machine), address_(address) {}

  virtual bool set(std::uint8_t number, std::uint8_t value) = 0;  // false: no acknowledge
  virtual std::uint8_t get(std::uint8_t number) = 0;
  virtual std::uint8_t next(std::uint8_t number) const { return static_cast<std::uint8_t>(number + 1); }
  /// Takes a new sample if the chip is running.
  virtual void sample() = 0;
  virtual std::uint8_t id_register() const = 0;

  void fail(SensorProblem problem, const char* sentence, std::uint8_t number, std::uint8_t value);
  bool starting() const { return machine_.now() < ready_at_; }
  void busy_for_ms(Cycles ms) { ready_at_ = machine_.now() + ms * 1000 * kCyclesPerMicrosecond; }
  /// The upper (0) or lower (1) byte of each axis, two by two.
  std::uint8_t rate_byte(std::size_t place) const;
  void take_rates(double count_radps);
  /// As a reset does. The rates stay 0 until the chip measures.
  void clear_rates() { counts_ = {}; }

  Rates rates_;

 private:
  Machine& machine_;
  std::uint8_t address_;
  std::uint8_t number_ = 0;
  bool expects_number_ = true;
  int bytes_read_ = 0;
  Cycles ready_at_ = 0;
  std::array<std::int16_t, 3> counts_{};
};

/// FXAS21002C, data sheet revision 2.1. Its registers but for standby and reset may be changed in standby only, and it does not
/// acknowledge the write that resets it.
class Fxas21002c : public GyroChip {
 public:
  Fxas21002c(Machine& machine, Rates rates, std::uint8_t address = 0x21)
      : GyroChip(machine, address, std::move(rates)) {
    power_on();
  }
  void power_on() override;

 private:
  bool set(std::uint8_t number, std::uint8_t value) override;
  std::uint8_t get(std::uint8_t number) override;
  std::uint8_t next(std::uint8_t number) const override;
  void sample() override;
  std::uint8_t id_register() const override { return 0x0C; }

  std::uint8_t control0_ = 0, control1_ = 0, control3_ = 0;
};

/// MPU-6050, register map revision 4.2. It sleeps until it is woken.
class Mpu6050 : public GyroChip {
 public:
  Mpu6050(Machine& machine, Rates rates, std::uint8_t address = 0x68)
      : GyroChip(machine, address, std::move(rates)) {
    power_on();
  }
  void power_on() override;

 private:
  bool set(std::uint8_t number, std::uint8_t value) override;
  std::uint8_t get(std::uint8_t number) override;
  void sample() override;
  std::uint8_t id_register() const override { return 0x75; }

  std::uint8_t power_ = 0, divider_ = 0, filter_ = 0, range_ = 0;
};

/// ICM-20948, data sheet revision 1.3. It sleeps until it is woken, and its registers are in banks.
class Icm20948 : public GyroChip {
 public:
  Icm20948(Machine& machine, Rates rates, std::uint8_t address = 0x69)
      : GyroChip(machine, address, std::move(rates)) {
    power_on();
  }
  void power_on() override;

 private:
  bool set(std::uint8_t number, std::uint8_t value) override;
  std::uint8_t get(std::uint8_t number) override;
  void sample() override;
  std::uint8_t id_register() const override { return 0x00; }

  std::uint8_t power_ = 0, bank_ = 0, divider_ = 0, range_ = 0;
};

}  // namespace astro::emulator
