#include "host/emulator/chip/pit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hal/teensy40/registers/registers.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr int kPitIrq = 122;
constexpr std::uint32_t kEnabled = 1, kInterrupts = 2, kChained = 4;
constexpr std::uint32_t kChannels = 0x100;  // where the first one's four registers are
constexpr std::uint32_t kLoad = 0, kValue = 4, kControl = 8;

}  // namespace

void Pit::reset() {
  channels_ = {};
  stopped_ = true;
  held_low_ = 0;
}

std::uint64_t Pit::lifetime_us() const {
  const Channel& first = channels_[0];
  return (first.control & kEnabled) != 0 ? (machine_.now() - first.began) / kCyclesPerMicrosecond : 0;
}

void Pit::age(std::uint64_t counts) {
  catch_up();
  Channel &lower = channels_[0], &upper = channels_[1];
  const std::uint64_t left = (std::uint64_t{upper.count} << 32 | current(lower)) - counts;
  lower.due = machine_.now() + ((left & 0xFFFF'FFFF) + 1) * cycles_per_count();
  lower.began -= counts * cycles_per_count();
  lower.began_anew = true;
  upper.count = static_cast<std::uint32_t>(left >> 32);
  update();
}

Cycles Pit::cycles_per_count() const { return kCyclesPerSecond / ccm_.timer_hz(); }

std::uint32_t Pit::current(const Channel& channel) const {
  if (channel.due == kNever) return channel.count;
  return static_cast<std::uint32_t>((channel.due - machine_.now() - 1) / cycles_per_count());
}

void Pit::begin_period(Channel& channel, Cycles at) {
  channel.count = channel.load;
  const bool clocked = !stopped_ && (channel.control & kEnabled) != 0 && (channel.control & kChained) == 0;
  channel.due = clocked ? at + (Cycles{channel.load} + 1) * cycles_per_count() : kNever;
}

/// Channel n has reached zero; channels chained to it may follow.
void Pit::end_period(std::size_t n) {
  channels_[n].flag = channels_[n].began_anew = true;
  begin_period(channels_[n], channels_[n].due);
  for (++n; n < channels_.size(); ++n) {
    Channel& next = channels_[n];
    if ((next.control & (kEnabled | kChained)) != (kEnabled | kChained)) return;
    if (next.count != 0) {
      --next.count;
      return;
    }
    next.flag = true;
    next.count = next.load;
  }
}

void Pit::catch_up() {
  for (std::size_t n = 0; n < channels_.size(); ++n)
    while (channels_[n].due <= machine_.now()) end_period(n);
}

std::uint32_t Pit::read(std::uint32_t offset) {
  catch_up();
  update();
  if (offset == pit::MCR.value) return pit::MCR_MDIS(stopped_);
  if (offset == pit::LTMR64H.value) {
    held_low_ = current(channels_[0]);
    const bool late = channels_[0].began_anew && held_low_ == channels_[0].load;
    return current(channels_[1]) + (late ? 1 : 0);
  }
  if (offset == pit::LTMR64L.value) return held_low_;
  const Channel& channel = channels_[(offset - kChannels) / 16];
  if (offset % 16 == kLoad) return channel.load;
  if (offset % 16 == kValue) return current(channel);
  return offset % 16 == kControl ? channel.control : channel.flag;
}

void Pit::set_stopped(bool stopped) {
  for (Channel& channel : channels_) channel.count = current(channel);
  stopped_ = stopped;
  for (Channel& channel : channels_) {
    const std::uint32_t count = channel.count;
    begin_period(channel, machine_.now());
    if (channel.due != kNever) channel.due -= (Cycles{channel.load} - count) * cycles_per_count();
    channel.count = count;
  }
}

void Pit::set_control(std::size_t n, std::uint32_t value) {
  Channel& channel = channels_[n];
  if (n == 0 && (value & kChained) != 0)
    machine_.fail(
        {"PIT CHANNEL0_TCTRL: there is no channel to chain it to", PitProblem::nothing_to_chain_to, {"0"}});
  const bool ran = (channel.control & kEnabled) != 0, runs = (value & kEnabled) != 0;
  if (!ran && runs && stopped_)
    machine_.fail({fmt::format("PIT CHANNEL{}_TCTRL: started while MCR.MDIS stops the module", n),
                   PitProblem::module_stopped,
                   {std::to_string(n)}});
  if (ran && runs && ((channel.control ^ value) & kChained) != 0)
    machine_.fail({fmt::format("PIT CHANNEL{}_TCTRL: chained or unchained while it counts", n),
                   PitProblem::chained_while_counting,
                   {std::to_string(n)}});
  channel.control = value;
  if (ran == runs) return;
  channel.began = machine_.now();
  channel.began_anew = false;
  begin_period(channel, machine_.now());
}

void Pit::write(std::uint32_t offset, std::uint32_t value) {
  catch_up();
  if (offset == pit::MCR.value) {
    set_stopped(pit::MCR_MDIS.of(value) != 0);
  } else if (offset < kChannels || offset % 16 == kValue) {
    machine_.fail({fmt::format("PIT 0x{:03X}: a count cannot be written", offset),
                   PitProblem::count_written,
                   {fmt::format("0x{:03X}", offset)}});
  } else {
    const std::size_t n = (offset - kChannels) / 16;
    if (offset % 16 == kLoad)
      channels_[n].load = value;
    else if (offset % 16 == kControl)
      set_control(n, value);
    else if ((value & 1) != 0)
      channels_[n].flag = false;
  }
  update();
}

void Pit::event() {
  catch_up();
  update();
}

void Pit::update() {
  Cycles next = kNever;
  bool level = false;
  for (const Channel& channel : channels_) {
    next = std::min(next, channel.due);
    level = level || (channel.flag && (channel.control & kInterrupts) != 0);
  }
  machine_.set_interrupt(kPitIrq, level);
  machine_.wake(*this, next);
}

}  // namespace astro::emulator
