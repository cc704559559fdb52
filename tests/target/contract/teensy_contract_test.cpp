#include <cmath>
#include <cstdlib>

#include "tests/contract/board_contract.hpp"
#include "tests/contract/gyro_contract.hpp"
#include "tests/contract/io_contract.hpp"
#include "tests/target/contract/teensy_rig.hpp"

/// The contract of hal/interface on the drivers of the Teensy, run by the emulator.
namespace astro::contract {
namespace {

class TeensyRig {
 public:
  target::TeensyBoard& board() { return board_; }
  void pass_ms(int ms) { teensy().run_for(std::chrono::milliseconds(ms)); }
  void set_counts(hal::EncoderCounts counts) {
    teensy().encoder(0).preset(counts.left);
    teensy().encoder(1).preset(counts.right);
  }
  void turn(hal::EncoderCounts by) { teensy().turn_shafts(by.left, by.right); }
  Bridge bridge() {
    pass_ms(1);  // the PWM takes new values when its period ends
    const auto state = teensy().world().bridges();
    if (state.open[0] && state.open[1]) return Bridge::coast;
    return state.duty[0] == 0 && state.duty[1] == 0 ? Bridge::brake : Bridge::drive;
  }
  /// What the pins show, or what was asked for where that is the same on the PWM's coarser grid.
  hal::Duty duty() {
    const auto state = teensy().world().bridges();
    return {on_grid(state.duty[0], board_.motors().asked.left),
            on_grid(state.duty[1], board_.motors().asked.right)};
  }
  void turn_body(double rate_radps) { teensy().world().turn_body(rate_radps); }
  void plug_gyro(bool plugged) {
    if (plugged) teensy().gyro()->power_on();
    teensy().gyro()->fault = plugged ? emulator::SensorFault::none : emulator::SensorFault::unplugged;
  }
  std::size_t up() { return 2; }
  void set_driver_fault(bool fault) { teensy().world().set_driver_fault(fault); }
  bool host_send(int, std::span<const std::uint8_t> bytes) {
    teensy().serial().send(bytes);
    return true;
  }
  std::vector<std::uint8_t> host_receive(int) {
    pass_ms(30);  // 2 KB at 1 Mbit/s
    return teensy().serial().receive();
  }
  std::array<std::uint8_t, 16> other_id() {
    target::Puppet other(2);
    return target::TeensyBoard(other).system().unique_id();
  }
  std::array<std::uint8_t, 16> restarted_id() {
    teensy().power_cycle();
    puppet_.start();
    return board_.system().unique_id();
  }

 protected:
  emulator::Teensy& teensy() { return puppet_.teensy(); }

 private:
  static std::int16_t on_grid(double duty, std::int16_t asked) {
    constexpr double kHalfCount = 0.5 / 7500;
    if (std::abs(duty - asked / 32767.0) <= kHalfCount) return asked;
    return static_cast<std::int16_t>(std::lround(duty * 32767));
  }

  target::Puppet puppet_{1};
  target::TeensyBoard board_{puppet_};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Teensy40, BoardContract, TeensyRig);
INSTANTIATE_TYPED_TEST_SUITE_P(Teensy40, IoContract, TeensyRig);

/// The same with each of the chips that the board knows.
template <class Chip>
class TeensyWith : public TeensyRig {
 public:
  TeensyWith() { teensy().plug<Chip>(); }
};
using TeensyGyros = testing::Types<TeensyRig, TeensyWith<emulator::Mpu6050>, TeensyWith<emulator::Icm20948>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Teensy40, GyroContract, TeensyGyros);

}  // namespace
}  // namespace astro::contract
