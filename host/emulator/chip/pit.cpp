#include "host/emulator/chip/pit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hal/teensy40/registers/registers.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr int kIrq = 122;
constexpr std::uint32_t kEnabled = 1, kInterrupts = 2, kChained = 4;

}  // namespace

void Pit::reset() {
  channels_ = {};
  disabled_ = true;
  held_low_ = 0;
}

Cycles Pit::cycles_per_count() const { return kCyclesPerSecond / ccm_.timer_hz(); }

std::uint64_t Pit::counted(std::size_t n) const {
  const Channel& channel = channels_[n];
  if ((channel.control & kEnabled) == 0) return 0;
  if ((channel.control & kChained) != 0) return counted(n - 1) / (std::uint64_t{channels_[n - 1].load} + 1);
  return (machine_.now() - channel.began) / cycles_per_count();
}

std::uint32_t Pit::current(std::size_t n) const {
  const std::uint64_t period = std::uint64_t{channels_[n].load} + 1;
  return static_cast<std::uint32_t>(channels_[n].load - counted(n) % period);
}

std::uint32_t Pit::read(std::uint32_t offset) {
  if (offset == pit::MCR.value) return disabled_ ? pit::MCR_MDIS(1) : 0;
  if (offset == pit::LTMR64H.value) {
    held_low_ = current(0);
    return current(1);
  }
  if (offset == pit::LTMR64L.value) return held_low_;
  const std::size_t n = (offset - 0x100) / 16;
  switch (offset % 16) {
    case 0:
      return channels_[n].load;
    case 4:
      return current(n);
    case 8:
      return channels_[n].control;
    default:
      return channels_[n].flag ? 1 : 0;
  }
}

void Pit::write(std::uint32_t offset, std::uint32_t value) {
  if (offset == pit::MCR.value) {
    disabled_ = pit::MCR_MDIS.of(value) != 0;
    return;
  }
  if (offset < 0x100) return machine_.fail("PIT LTMR64H: the lifetime timer cannot be written");
  const std::size_t n = (offset - 0x100) / 16;
  if (offset % 16 == 0) channels_[n].load = value;
  if (offset % 16 == 4) machine_.fail("PIT CVAL: cannot be written");
  if (offset % 16 == 8) set_control(n, value);
  if (offset % 16 == 12 && (value & 1) != 0) channels_[n].flag = false;
  update();
}

void Pit::set_control(std::size_t n, std::uint32_t value) {
  Channel& channel = channels_[n];
  const bool starts = (channel.control & kEnabled) == 0 && (value & kEnabled) != 0;
  if (starts && disabled_)
    machine_.fail(fmt::format("PIT CHANNEL{}_TCTRL: started while MCR.MDIS stops the module", n));
  if (n == 0 && (value & kChained) != 0)
    machine_.fail("PIT CHANNEL0_TCTRL: there is no channel to chain it to");
  channel.control = value;
  if (starts) channel.began = machine_.now();
  const bool wanted = (value & kEnabled) != 0 && (value & kChained) == 0 && (value & kInterrupts) != 0;
  if (!wanted) channel.due = kNever;
  if (wanted && (starts || channel.due == kNever))
    channel.due = machine_.now() + (Cycles{current(n)} + 1) * cycles_per_count();
}

void Pit::event() {
  for (Channel& channel : channels_)
    if (channel.due <= machine_.now()) {
      channel.flag = true;
      channel.due += (Cycles{channel.load} + 1) * cycles_per_count();
    }
  update();
}

void Pit::update() {
  Cycles next = kNever;
  bool level = false;
  for (const Channel& channel : channels_) {
    next = std::min(next, channel.due);
    level = level || (channel.flag && (channel.control & kInterrupts) != 0);
  }
  machine_.set_interrupt(kIrq, level);
  machine_.wake(*this, next);
}

}  // namespace astro::emulator
