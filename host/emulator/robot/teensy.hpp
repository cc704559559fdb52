#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "hal/sim/config.hpp"
#include "host/emulator/chip/adc.hpp"
#include "host/emulator/chip/clocks.hpp"
#include "host/emulator/chip/decoders.hpp"
#include "host/emulator/chip/flexpwm.hpp"
#include "host/emulator/chip/flexspi.hpp"
#include "host/emulator/chip/gpio.hpp"
#include "host/emulator/chip/iomuxc.hpp"
#include "host/emulator/chip/lpi2c.hpp"
#include "host/emulator/chip/lpuart.hpp"
#include "host/emulator/chip/pit.hpp"
#include "host/emulator/chip/reset.hpp"
#include "host/emulator/chip/watchdogs.hpp"
#include "host/emulator/core/chip.hpp"
#include "host/emulator/robot/controller.hpp"
#include "host/emulator/robot/gyro_chips.hpp"
#include "host/emulator/robot/world.hpp"

namespace astro::emulator {

/// A Teensy 4.0 on a robot, in this process and in virtual time: runs the very image that users flash.
///
///   Teensy teensy("build/teensy40/bin/astrolabe-teensy40.hex");
///   teensy.run_for(10ms);
///
/// If the .elf lies beside the .hex, messages name functions. The same image, configuration and calls give
/// the same state. Throws Stopped if the firmware does something that fails on the chip; each model says
/// what.
class Teensy {
 public:
  explicit Teensy(const std::filesystem::path& hex, const sim::Config& robot = {},
                  HandOver hand_over = HandOver::untidy);

  void run_for(std::chrono::nanoseconds time);
  /// Runs until `done`, asked every `step`; false if that takes longer than `limit`.
  bool run_until(const std::function<bool()>& done, std::chrono::nanoseconds limit,
                 std::chrono::nanoseconds step = std::chrono::microseconds(100));

  Cycles now() const { return chip_.now(); }
  std::uint64_t now_us() const { return chip_.now() / kCyclesPerMicrosecond; }
  /// The firmware's own clock: time since it started the PIT.
  std::uint64_t robot_clock_us() const { return pit_.lifetime_us(); }
  std::uint64_t instructions() { return chip_.cpu().instructions(); }
  bool in_bootloader() const { return chip_.in_bootloader(); }

  /// Switches the power off and on again; the flash keeps its content.
  void power_cycle();
  /// Presses the reset button.
  void press_reset() { chip_.start(Reset::pin); }

  Pit& timers() { return pit_; }
  Lpuart& serial() { return lpuart_; }
  Lpi2c& i2c() { return lpi2c_; }
  /// The chip at the I2C bus: a FXAS21002C if the robot has a gyro, none otherwise.
  GyroChip* gyro() { return gyro_.get(); }
  /// Puts another chip in its place: `plug<Mpu6050>()`. It measures what the robot's gyro would.
  template <class Chip>
  void plug() {
    gyro_ = std::make_unique<Chip>(chip_, [this] { return world_.gyro_radps(); });
    lpi2c_.devices = {gyro_.get()};
  }
  UsbController& usb() { return usb_; }
  World& world() { return world_; }
  FlashChip& flash() { return flash_; }
  FlexPwm& pwm() { return pwm_; }
  Gpio& gpio7() { return gpio7_; }
  Enc& encoder(std::size_t side) { return side == 0 ? enc1_ : enc2_; }
  Rtwdog& watchdog() { return rtwdog_; }
  Ccm& ccm() { return ccm_; }
  Chip& chip() { return chip_; }
  /// Turns both encoders' shafts by this many counts, as seen on their wires.
  void turn_shafts(std::int32_t left, std::int32_t right) {
    encoder_wires_.count(0, left);
    encoder_wires_.count(1, right);
  }
  std::uint32_t word_at(std::uint32_t address);
  /// A hash of processor, memories and time: equal after two equal runs.
  std::uint64_t state_hash();

 private:
  void map();

  Chip chip_;
  Analog analog_{chip_};
  Dcdc dcdc_{chip_};
  Ccm ccm_{chip_, analog_, dcdc_};
  Iomuxc iomuxc_;
  IomuxcGpr gpr_{chip_};
  Gpio gpio1_{chip_, gpr_, 1}, gpio2_{chip_, gpr_, 2}, gpio4_{chip_, gpr_, 4};
  Gpio gpio6_{chip_, gpr_, 6}, gpio7_{chip_, gpr_, 7}, gpio9_{chip_, gpr_, 9};
  Pit pit_{chip_, ccm_};
  Src src_;
  Ocotp ocotp_;
  Rtwdog rtwdog_{chip_};
  Wdog wdog1_{chip_, 1}, wdog2_{chip_, 2};
  Lpuart lpuart_{chip_, ccm_, iomuxc_};
  Lpi2c lpi2c_{chip_, ccm_, iomuxc_, gpio1_};
  Xbara xbara_;
  Enc enc1_{chip_, 1}, enc2_{chip_, 2};
  EncoderWires encoder_wires_{iomuxc_, gpr_, xbara_, enc1_, enc2_};
  FlexPwm pwm_{chip_, iomuxc_};
  Adc adc_{chip_, iomuxc_};
  FlashChip flash_{chip_, chip_.memory().flash()};
  Flexspi flexspi_{chip_, flash_};
  UsbPhy usb_phy_;
  UsbController usb_{chip_, [this] { return analog_.usb_pll_ready() && usb_phy_.ready(); }};
  World world_;
  std::unique_ptr<GyroChip> gyro_;
};

}  // namespace astro::emulator
