#include "host/emulator/robot/teensy.hpp"

#include <algorithm>

#include "hal/teensy40/registers/registers.hpp"
#include "host/base/bytes.hpp"
#include "host/formats/files/firmware_image.hpp"

namespace astro::emulator {
namespace {

constexpr Cycles cycles(std::chrono::nanoseconds time) { return static_cast<Cycles>(time.count()) * 3 / 5; }

}  // namespace

Teensy::Teensy(const std::filesystem::path& hex, const sim::Config& robot, HandOver hand_over)
    : chip_(hand_over),
      ocotp_(chip_, static_cast<std::uint32_t>(sim::identity_of(robot))),
      world_(chip_, robot, {pwm_, gpio7_, encoder_wires_, adc_, iomuxc_}) {
  const FirmwareImage image = read_firmware_image(hex);
  std::copy(image.flash.begin(), image.flash.end(), chip_.memory().flash().begin());
  const auto elf = std::filesystem::path(hex).replace_extension(".elf");
  if (std::filesystem::exists(elf)) chip_.symbols = Symbols(elf);
  const auto parameters = flash_.parameters();
  std::copy_n(robot.flash.begin(), std::min(parameters.size(), robot.flash.size()), parameters.begin());
  chip_.gates = [this](Gate gate) { return ccm_.open(gate); };
  chip_.remember_reset = [this](Reset cause) { src_.remember(cause); };
  gpr_.on_layout = [this](const Memory::Layout& layout) { chip_.set_layout(layout); };
  flash_.on_busy = [this](bool busy) { chip_.set_flash_busy(busy); };
  gpio1_.on_change = [this] { lpi2c_.pins_changed(); };
  if (robot.gyro) plug<Fxas21002c>();
  map();
  chip_.start(Reset::power_on);
}

void Teensy::map() {
  using namespace teensy40;
  const auto add = [this](Model& model, std::uint32_t base, std::optional<Gate> gate = {},
                          std::uint32_t bytes = Bus::kPage) {
    chip_.bus().map(model, base, bytes, gate);
    chip_.add(model);
  };
  add(analog_, CCM_ANALOG.base, Gate{6, 11});
  add(dcdc_, DCDC.base, Gate{6, 3});
  add(ccm_, CCM.base);
  add(iomuxc_, IOMUXC.base, Gate{4, 1});
  add(gpr_, IOMUXC_GPR.base, Gate{4, 2});
  add(gpio1_, GPIO1.base, Gate{1, 13});
  add(gpio2_, GPIO2.base, Gate{0, 15});
  add(gpio4_, GPIO4.base, Gate{3, 6});
  add(gpio6_, GPIO6.base);
  add(gpio7_, GPIO7.base);
  add(gpio9_, GPIO9.base);
  add(pit_, PIT.base, Gate{1, 6});
  add(src_, SRC.base);
  add(ocotp_, OCOTP.base, Gate{2, 6});
  add(rtwdog_, RTWDOG.base, Gate{5, 2});
  add(wdog1_, WDOG1.base, Gate{3, 8});
  add(wdog2_, WDOG2.base, Gate{5, 5});
  add(lpuart_, LPUART6.base, Gate{3, 3});
  add(lpi2c_, LPI2C1.base, Gate{2, 3});
  add(xbara_, XBARA1.base, Gate{2, 11});
  add(enc1_, ENC1.base, Gate{4, 12});
  add(enc2_, ENC2.base, Gate{4, 13});
  add(pwm_, PWM2.base, Gate{4, 9});
  add(adc_, ADC1.base, Gate{1, 8});
  add(flexspi_, FLEXSPI.base, Gate{6, 5});
  add(usb_, USB1.base, Gate{6, 0});
  add(usb_phy_, USBPHY1.base);
  chip_.add(flash_);
  chip_.add(world_);
}

void Teensy::run_for(std::chrono::nanoseconds time) { chip_.run_until(chip_.now() + cycles(time)); }

bool Teensy::run_until(const std::function<bool()>& done, std::chrono::nanoseconds limit,
                       std::chrono::nanoseconds step) {
  const Cycles end = chip_.now() + cycles(limit);
  while (!done()) {
    if (chip_.now() >= end) return false;
    chip_.run_until(std::min(end, chip_.now() + cycles(step)));
  }
  return true;
}

void Teensy::power_cycle() {
  flash_.restore_power();
  if (gyro_) gyro_->power_on();
  // Without power the RAM loses its content.
  for (const Memory::Range& range : chip_.memory().ranges())
    if (range.writable) std::fill(range.bytes.begin(), range.bytes.end(), std::uint8_t{0xA5});
  chip_.start(Reset::power_on);
}

std::uint32_t Teensy::word_at(std::uint32_t address) {
  const auto bytes = chip_.memory().at(address, 4);
  return bytes.empty() ? 0 : load<std::uint32_t>(bytes, 0);
}

std::uint64_t Teensy::state_hash() {
  std::uint64_t hash = 0xCBF2'9CE4'8422'2325;  // FNV-1a, by words
  const auto add = [&hash](std::uint64_t word) { hash = (hash ^ word) * 0x0000'0100'0000'01B3; };
  for (const Memory::Range& range : chip_.memory().ranges())
    for (std::size_t at = 0; at < range.bytes.size(); at += sizeof(std::uint64_t))
      add(load<std::uint64_t>(range.bytes, at));
  for (int reg = UC_ARM_REG_R0; reg <= UC_ARM_REG_R12; ++reg) add(chip_.cpu().get(reg));
  for (const int reg :
       {UC_ARM_REG_SP, UC_ARM_REG_LR, UC_ARM_REG_PC, UC_ARM_REG_XPSR, UC_ARM_REG_PRIMASK, UC_ARM_REG_BASEPRI})
    add(chip_.cpu().get(reg));
  add(now());
  add(instructions());
  return hash;
}

}  // namespace astro::emulator
