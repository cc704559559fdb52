#include "hal/teensy40/core/core_clock.hpp"

#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/registers/registers.hpp"

namespace astro::teensy40::core_clock {
namespace {

void wait_while(Bits busy) {
  while (CCM[ccm::CDHIPR].get(busy) != 0) {
  }
}

/// 1.25 V, before the clock rises.
void raise_supply() {
  constexpr std::uint32_t kTarget = (1250 - 800) / 25;
  open_gate(CCM[ccm::CCGR6], ccm::CCGR6_CG3);
  DCDC[dcdc::REG3].modify(dcdc::REG3_TRG.mask(), dcdc::REG3_TRG(kTarget));
  while (DCDC[dcdc::REG0].get(dcdc::REG0_STS_DC_OK) == 0) {
  }
}

/// The core runs from the crystal while its PLL is set up.
void detour() {
  constexpr std::uint32_t kCrystal = 1;
  CCM[ccm::CBCDR].modify(ccm::CBCDR_PERIPH_CLK2_PODF.mask(), 0);
  CCM[ccm::CBCMR].modify(ccm::CBCMR_PERIPH_CLK2_SEL.mask(), ccm::CBCMR_PERIPH_CLK2_SEL(kCrystal));
  wait_while(ccm::CDHIPR_PERIPH_CLK_SEL_BUSY);
  CCM[ccm::CBCDR].modify(0, ccm::CBCDR_PERIPH_CLK_SEL(1));
  wait_while(ccm::CDHIPR_PERIPH_CLK_SEL_BUSY);
}

void start_pll() {
  constexpr std::uint32_t kMultiplier = 100;  // of 12 MHz
  CCM_ANALOG[ccm_analog::PLL_ARM].write(ccm_analog::PLL_ARM_POWERDOWN(1));
  CCM_ANALOG[ccm_analog::PLL_ARM].write(ccm_analog::PLL_ARM_ENABLE(1) |
                                        ccm_analog::PLL_ARM_DIV_SELECT(kMultiplier));
  while (CCM_ANALOG[ccm_analog::PLL_ARM].get(ccm_analog::PLL_ARM_LOCK) == 0) {
  }
}

void divide() {
  CCM[ccm::CACRR].write(ccm::CACRR_ARM_PODF(1));  // 1200 MHz by 2
  wait_while(ccm::CDHIPR_ARM_PODF_BUSY);
  CCM[ccm::CBCDR].modify(ccm::CBCDR_AHB_PODF.mask(), 0);
  wait_while(ccm::CDHIPR_AHB_PODF_BUSY);
  CCM[ccm::CBCDR].modify(ccm::CBCDR_IPG_PODF.mask(), ccm::CBCDR_IPG_PODF(3));  // 600 MHz by 4
}

void join() {
  constexpr std::uint32_t kArmPll = 3;
  CCM[ccm::CBCMR].modify(ccm::CBCMR_PRE_PERIPH_CLK_SEL.mask(), ccm::CBCMR_PRE_PERIPH_CLK_SEL(kArmPll));
  CCM[ccm::CBCDR].modify(ccm::CBCDR_PERIPH_CLK_SEL.mask(), 0);
  wait_while(ccm::CDHIPR_PERIPH_CLK_SEL_BUSY);
}

/// Makes `wfi` stop only the core. With the settings after reset the chip would enter its wait mode, in which
/// the watchdog stops and the other bus masters cannot reach the memories of the sleeping core.
void sleep_lightly() {
  CCM[ccm::CLPCR].modify(ccm::CLPCR_LPM.mask(), 0);
  IOMUXC_GPR[iomuxc_gpr::GPR1].modify(0, iomuxc_gpr::GPR1_CM7_FORCE_HCLK_EN(1));
}

}  // namespace

void start() {
  sleep_lightly();
  CCM[ccm::CSCMR1].modify(ccm::CSCMR1_PERCLK_PODF.mask(), ccm::CSCMR1_PERCLK_CLK_SEL(1));
  CCM[ccm::CSCDR1].modify(ccm::CSCDR1_UART_CLK_PODF.mask(), ccm::CSCDR1_UART_CLK_SEL(1));
  raise_supply();
  detour();
  start_pll();
  divide();
  join();
}

}  // namespace astro::teensy40::core_clock
