#include "hal/teensy40/clock.hpp"

#include "hal/teensy40/core/cpu.hpp"

namespace astro::teensy40 {

void Clock::start() {
  open_gate(CCM[ccm::CCGR1], ccm::CCGR1_CG6);
  PIT[pit::MCR].write(0);
  PIT[pit::CHANNEL0_TCTRL].write(0);
  PIT[pit::CHANNEL1_TCTRL].write(0);
  PIT[pit::CHANNEL2_TCTRL].write(0);
  PIT[pit::CHANNEL3_TCTRL].write(0);

  PIT[pit::CHANNEL1_LDVAL].write(~0U);
  PIT[pit::CHANNEL0_LDVAL].write(~0U);
  PIT[pit::CHANNEL1_TCTRL].write(pit::CHANNEL1_TCTRL_CHN(1));
  PIT[pit::CHANNEL1_TCTRL].write(pit::CHANNEL1_TCTRL_CHN(1) | pit::CHANNEL1_TCTRL_TEN(1));
  PIT[pit::CHANNEL0_TCTRL].write(pit::CHANNEL0_TCTRL_TEN(1));
}

}  // namespace astro::teensy40
