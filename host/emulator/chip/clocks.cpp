#include "host/emulator/chip/clocks.hpp"

#include <fmt/format.h>

#include "hal/teensy40/registers/registers.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr Cycles kLock = 60 * kCyclesPerMicrosecond, kSettle = 30 * kCyclesPerMicrosecond, kHandshake = 600;
constexpr std::uint32_t kCrystal_mhz = 24;
// The core may go above 528 MHz with 1.25 V, which the Teensy's makers use.
constexpr std::uint32_t kSlow_mhz = 528, kFast_mV = 1250, kMost_mV = 1300;

/// Registers with copies that set, clear and toggle bits 4, 8 and 12 bytes on.
std::uint32_t combined(std::uint32_t offset, std::uint32_t old, std::uint32_t value) {
  switch (offset & 0xC) {
    case 4:
      return old | value;
    case 8:
      return old & ~value;
    case 12:
      return old ^ value;
    default:
      return value;
  }
}

constexpr std::uint32_t kArm = ccm_analog::PLL_ARM.value, kUsb = ccm_analog::PLL_USB1.value;

}  // namespace

Analog::Analog(Machine& machine)
    // As the ROM leaves them: 792 MHz for the core, the USB PLL running for the flash.
    : Stored({{kArm, 0x0000'2042},
              {kUsb, 0x0000'3000},
              {pmu::REG_3P0.value, 0x0000'0F74},
              {pmu::MISC0.value, 0x0400'0000}}),
      machine_(machine) {}

void Analog::reset() {
  Stored::reset();
  arm_locked_at_ = usb_locked_at_ = 0;
}

std::uint32_t Analog::arm_pll_mhz() const {
  return ccm_analog::PLL_ARM_DIV_SELECT.of(value(kArm)) * kCrystal_mhz / 2;
}

bool Analog::arm_pll_bypassed() const { return ccm_analog::PLL_ARM_BYPASS.of(value(kArm)) != 0; }

bool Analog::usb_pll_ready() const {
  const std::uint32_t pll = value(kUsb);
  return ccm_analog::PLL_USB1_EN_USB_CLKS.of(pll) != 0 && ccm_analog::PLL_USB1_ENABLE.of(pll) != 0 &&
         ccm_analog::PLL_USB1_POWER.of(pll) != 0 && ccm_analog::PLL_USB1_BYPASS.of(pll) == 0 &&
         ccm_analog::PLL_USB1_DIV_SELECT.of(pll) == 0 &&  // 480 MHz
         machine_.now() >= usb_locked_at_;
}

std::uint32_t Analog::read(std::uint32_t offset) {
  const std::uint32_t base = offset & ~0xFU;
  std::uint32_t word = value(base);
  if (base == kArm && arm_pll_locked()) word |= ccm_analog::PLL_ARM_LOCK(1);
  if (base == kUsb && machine_.now() >= usb_locked_at_) word |= ccm_analog::PLL_USB1_LOCK(1);
  return word;
}

void Analog::write(std::uint32_t offset, std::uint32_t value_written) {
  const std::uint32_t base = offset & ~0xFU;
  const std::uint32_t old = value(base), word = combined(offset, old, value_written);
  if (base == kArm) {
    if (core_runs_from_arm_pll())
      machine_.fail({"CCM_ANALOG PLL_ARM: changed while the core runs from it", ClockProblem::pll_in_use});
    const std::uint32_t factor = ccm_analog::PLL_ARM_DIV_SELECT.of(word);
    const bool on = ccm_analog::PLL_ARM_POWERDOWN.of(word) == 0 && ccm_analog::PLL_ARM_ENABLE.of(word) != 0;
    if (on && (factor < 54 || factor > 108))
      machine_.fail(
          {"CCM_ANALOG PLL_ARM: DIV_SELECT is not within 54..108", ClockProblem::pll_factor_out_of_range});
    arm_locked_at_ = on ? machine_.now() + kLock : kNever;
  }
  if (base == kUsb && ccm_analog::PLL_USB1_POWER.of(word) != ccm_analog::PLL_USB1_POWER.of(old))
    usb_locked_at_ = ccm_analog::PLL_USB1_POWER.of(word) != 0 ? machine_.now() + kLock : kNever;
  store(base, word);
}

Dcdc::Dcdc(Machine& machine)
    : Stored({{dcdc::REG0.value, 0x1403'0111}, {dcdc::REG3.value, 0x0000'010E}}), machine_(machine) {}

std::uint32_t Dcdc::read(std::uint32_t offset) {
  const bool settled = machine_.now() >= settled_at_;
  return value(offset) | (offset == dcdc::REG0.value && settled ? dcdc::REG0_STS_DC_OK(1) : 0);
}

void Dcdc::write(std::uint32_t offset, std::uint32_t value_written) {
  if (offset == dcdc::REG3.value) {
    const std::uint32_t target_mV = 800 + 25 * dcdc::REG3_TRG.of(value_written);
    if (target_mV > kMost_mV)
      machine_.fail({"DCDC REG3: more than 1.3 V for the core", ClockProblem::voltage_too_high});
    if (target_mV < kFast_mV && core_mhz() > kSlow_mhz)
      machine_.fail({fmt::format("DCDC REG3: {} mV for a core that runs at {} MHz", target_mV, core_mhz()),
                     ClockProblem::voltage_too_low,
                     {std::to_string(target_mV), std::to_string(core_mhz())}});
    settled_at_ = machine_.now() + kSettle;
  }
  store(offset, value_written);
}

std::uint32_t Dcdc::millivolts() const {
  return machine_.now() < settled_at_ ? 0 : 800 + 25 * dcdc::REG3_TRG.of(value(dcdc::REG3.value));
}

Ccm::Ccm(Machine& machine, Analog& analog, Dcdc& dcdc)
    : Stored({{ccm::CACRR.value, 1},
              {ccm::CBCDR.value, 0x000A'8200},  // 396 MHz, bus at a third, as the ROM leaves it
              {ccm::CBCMR.value, 0x2DAE'8324},
              {ccm::CSCMR1.value, 0x0490'0000},
              {ccm::CSCDR1.value, 0x0649'0B00},
              {ccm::CSCDR2.value, 0x0002'9150},
              {ccm::CLPCR.value, 0x79},
              {ccm::CCGR0.value, ~0U},
              {ccm::CCGR1.value, ~(ccm::CCGR1_CG6.mask() | ccm::CCGR1_CG8.mask())},
              {ccm::CCGR2.value, ~(ccm::CCGR2_CG3.mask() | ccm::CCGR2_CG6.mask() | ccm::CCGR2_CG11.mask())},
              {ccm::CCGR3.value, ~ccm::CCGR3_CG3.mask()},
              {ccm::CCGR4.value, 0x0000'FFFF},
              {ccm::CCGR5.value, ~0U},
              {ccm::CCGR6.value, ~(ccm::CCGR6_CG0.mask() | ccm::CCGR6_CG3.mask())}}),
      machine_(machine),
      analog_(analog),
      dcdc_(dcdc) {
  analog_.core_runs_from_arm_pll = [this] { return from_pll(); };
  dcdc_.core_mhz = [this] { return core_mhz(); };
}

void Ccm::reset() {
  Stored::reset();
  busy_ = 0;
  busy_until_ = 0;
}

bool Ccm::from_pll() const {
  return ccm::CBCDR_PERIPH_CLK_SEL.of(value(ccm::CBCDR.value)) == 0 &&
         ccm::CBCMR_PRE_PERIPH_CLK_SEL.of(value(ccm::CBCMR.value)) == 3;
}

bool Ccm::open(Gate gate) const {
  const std::uint32_t word = value(ccm::CCGR0.value + 4 * static_cast<std::uint32_t>(gate.reg));
  return (word >> (2 * gate.index) & 3) != 0;
}

std::uint32_t Ccm::core_mhz() const {
  const std::uint32_t source =
      from_pll() ? analog_.arm_pll_mhz() / (1 + ccm::CACRR_ARM_PODF.of(value(ccm::CACRR.value)))
                 : kCrystal_mhz;
  return source / (1 + ccm::CBCDR_AHB_PODF.of(value(ccm::CBCDR.value)));
}

std::uint32_t Ccm::bus_mhz() const {
  return core_mhz() / (1 + ccm::CBCDR_IPG_PODF.of(value(ccm::CBCDR.value)));
}

std::uint32_t Ccm::uart_hz() const {
  const std::uint32_t word = value(ccm::CSCDR1.value);
  return (ccm::CSCDR1_UART_CLK_SEL.of(word) != 0 ? 24'000'000 : 80'000'000) /
         (1 + ccm::CSCDR1_UART_CLK_PODF.of(word));
}

std::uint32_t Ccm::i2c_hz() const {
  const std::uint32_t word = value(ccm::CSCDR2.value);
  return (ccm::CSCDR2_LPI2C_CLK_SEL.of(word) != 0 ? 24'000'000 : 60'000'000) /
         (1 + ccm::CSCDR2_LPI2C_CLK_PODF.of(word));
}

std::uint32_t Ccm::timer_hz() const {
  const std::uint32_t word = value(ccm::CSCMR1.value);
  return (ccm::CSCMR1_PERCLK_CLK_SEL.of(word) != 0 ? 24'000'000 : bus_mhz() * 1'000'000) /
         (1 + ccm::CSCMR1_PERCLK_PODF.of(word));
}

std::uint32_t Ccm::read(std::uint32_t offset) {
  if (offset != ccm::CDHIPR.value) return value(offset);
  return machine_.now() < busy_until_ ? busy_ : 0;
}

void Ccm::check_source() {
  constexpr std::uint32_t kCrystal = 1, kArmPll = 3;
  const std::uint32_t sources = value(ccm::CBCMR.value);
  const bool detour = ccm::CBCDR_PERIPH_CLK_SEL.of(value(ccm::CBCDR.value)) != 0;
  if (detour && ccm::CBCMR_PERIPH_CLK2_SEL.of(sources) != kCrystal)
    machine_.fail({"CCM CBCMR: of the clocks behind PERIPH_CLK2_SEL only the crystal is modelled",
                   ClockProblem::crystal_not_selected});
  if (!detour && ccm::CBCMR_PRE_PERIPH_CLK_SEL.of(sources) != kArmPll)
    machine_.fail({"CCM CBCMR: of the clocks behind PRE_PERIPH_CLK_SEL only the ARM PLL is modelled",
                   ClockProblem::arm_pll_not_selected});
}

void Ccm::check_supply() {
  if (!from_pll()) return;
  if (!analog_.arm_pll_locked())
    machine_.fail(
        {"CCM CBCDR: the core is to run from a PLL that has not locked", ClockProblem::pll_not_locked});
  if (analog_.arm_pll_bypassed())
    machine_.fail({"CCM CBCDR: the core is to run from a PLL that is bypassed", ClockProblem::pll_bypassed});
  if (core_mhz() > kSlow_mhz && dcdc_.millivolts() < kFast_mV)
    machine_.fail({fmt::format("CCM CBCDR: {} MHz with less than 1.25 V (DCDC REG3)", core_mhz()),
                   ClockProblem::too_fast_for_voltage,
                   {std::to_string(core_mhz())}});
  if (core_mhz() > 600)
    machine_.fail({fmt::format("CCM CBCDR: {} MHz", core_mhz()),
                   ClockProblem::core_too_fast,
                   {std::to_string(core_mhz())}});
  if (bus_mhz() > 150)
    machine_.fail({fmt::format("CCM CBCDR: {} MHz for the bus, the most is 150", bus_mhz()),
                   ClockProblem::bus_too_fast,
                   {std::to_string(bus_mhz())}});
}

void Ccm::write(std::uint32_t offset, std::uint32_t word) {
  const bool handshakes = offset == ccm::CACRR.value || offset == ccm::CBCDR.value;
  if (handshakes && machine_.now() < busy_until_)
    machine_.fail({"CCM CDHIPR: a divider is changed while the last change is under way",
                   ClockProblem::last_change_under_way});
  const std::uint32_t changed = value(offset) ^ word;
  store(offset, word);
  std::uint32_t busy = 0;
  if (offset == ccm::CACRR.value && changed != 0) busy |= ccm::CDHIPR_ARM_PODF_BUSY(1);
  if (offset == ccm::CBCDR.value) {
    if (ccm::CBCDR_PERIPH_CLK_SEL.of(changed) != 0) busy |= ccm::CDHIPR_PERIPH_CLK_SEL_BUSY(1);
    if (ccm::CBCDR_AHB_PODF.of(changed) != 0) busy |= ccm::CDHIPR_AHB_PODF_BUSY(1);
  }
  if (busy != 0) {
    busy_ = busy;
    busy_until_ = machine_.now() + kHandshake;
  }
  if (handshakes || offset == ccm::CBCMR.value) {
    check_source();
    check_supply();
  }
  if (offset == ccm::CSCMR1.value && (timer_hz() == 0 || kCyclesPerSecond % timer_hz() != 0))
    machine_.fail({"CCM CSCMR1: a clock of the timers that is no whole part of 600 MHz is not modelled",
                   ClockProblem::timer_clock_not_whole});
}

}  // namespace astro::emulator
