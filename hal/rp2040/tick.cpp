#include "hal/rp2040/tick.hpp"

#include "hal/rp2040/core/interrupts.hpp"
#include "hal/rp2040/pins.hpp"

namespace astro::rp2040 {
namespace {

constexpr std::uint32_t kPeriod_us = 1000;
constexpr std::uint32_t kAhead_us =
    3;  // what the way from reading the timer to setting the alarm takes at most
constexpr std::uint32_t kLedTicks = 512;

void (*on_tick)() = nullptr;
std::uint32_t ticks = 0, due_us = 0;

/// Called where nothing interrupts, so that the moment lies ahead when it is set.
void arm_next() {
  const std::uint32_t soonest_us = TIMER[timer::TIMERAWL].read() + kAhead_us;
  do due_us += kPeriod_us;
  while (static_cast<std::int32_t>(due_us - soonest_us) < 0);
  TIMER[timer::ALARM0].write(due_us);
}

void timer_interrupt() {
  TIMER[timer::INTR].write(timer::INTR_ALARM_0(1));
  arm_next();
  on_tick();
  if (++ticks % kLedTicks == 0) SIO[sio::GPIO_OUT_XOR].write(1U << gp::kLed);
}

}  // namespace

void Tick::start(void (*handler)()) {
  on_tick = handler;
  const cpu::InterruptsOff guard;
  install(irq::kTimer0, urgency::kTick, timer_interrupt);
  TIMER[timer::INTR].write(timer::INTR_ALARM_0(1));
  TIMER[timer::INTE].set(timer::INTE_ALARM_0.mask());
  due_us = TIMER[timer::TIMERAWL].read();
  arm_next();
}

}  // namespace astro::rp2040
