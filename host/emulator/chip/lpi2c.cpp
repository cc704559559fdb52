#include "host/emulator/chip/lpi2c.hpp"

#include <fmt/format.h>

#include <array>

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::size_t kQueue = 4;
constexpr std::uint32_t kClock = 1U << 16, kData = 1U << 17;  // pins of GPIO1
constexpr std::uint32_t kOpenDrain = 1U << 11, kReadBack = 1U << 4, kI2cFunction = 3, kGpioFunction = 5;
constexpr std::uint32_t kSend = 0, kReceive = 1, kStop = 2, kStart = 4;
constexpr std::uint32_t kI2cEvents = lpi2c::MSR_EPF.mask() | lpi2c::MSR_SDF.mask() | lpi2c::MSR_NDF.mask() |
                                     lpi2c::MSR_ALF.mask() | lpi2c::MSR_FEF.mask() | lpi2c::MSR_PLTF.mask();
constexpr std::uint32_t kErrors =
    lpi2c::MSR_NDF.mask() | lpi2c::MSR_ALF.mask() | lpi2c::MSR_FEF.mask() | lpi2c::MSR_PLTF.mask();
constexpr int kByteBits = 9;
constexpr std::uint32_t kFastMode_hz = 400'000, kFastModeLow_ns = 1300;
constexpr Cycles kLookAgain = 10 * kCyclesPerMicrosecond;  // at a line that somebody holds

}  // namespace

void Lpi2c::reset() {
  control_ = events_ = configuration1_ = configuration2_ = timing_ = 0;
  commands_.clear();
  received_.clear();
  done_at_ = kNever;
  device_ = nullptr;
  owns_bus_ = reads_ = false;
  left_ = 0;
  starts_ = 0;
}

bool Lpi2c::enabled() const { return lpi2c::MCR_MEN.of(control_) != 0; }

void Lpi2c::hold_clock(bool held) {
  clock_held_ = held;
  show_lines();
}

void Lpi2c::hold_data(int clocks) {
  data_held_clocks_ = clocks;
  show_lines();
}

void Lpi2c::show_lines() {
  std::uint32_t levels = ~0U;
  if (clock_held_) levels &= ~kClock;
  if (data_held()) levels &= ~kData;
  gpio1_.set_inputs(levels);
}

// A clock by hand is a pin that pulls the line down and lets it go.
void Lpi2c::pins_changed() {
  const bool by_hand = iomuxc_.function(iomuxc::SW_MUX_CTL_PAD_GPIO_AD_B1_00.value) == kGpioFunction;
  if ((gpio1_.driven() & (kClock | kData)) != 0)
    return machine_.fail({"GPIO1: drives a line of the I2C bus high, which others may pull down",
                          Lpi2cProblem::not_open_drain});
  const bool low = by_hand && (gpio1_.outputs() & kClock) != 0;
  if (clock_was_low_ && !low && !clock_held_ && data_held()) --data_held_clocks_;
  clock_was_low_ = low;
  show_lines();
}

/// Whether both pads belong to the bus, as outputs that only pull down and whose level comes back in.
bool Lpi2c::connected() {
  for (const auto& [mux, pad, source] :
       {std::array{iomuxc::SW_MUX_CTL_PAD_GPIO_AD_B1_00.value, iomuxc::SW_PAD_CTL_PAD_GPIO_AD_B1_00.value,
                   iomuxc::LPI2C1_SCL_SELECT_INPUT.value},
        std::array{iomuxc::SW_MUX_CTL_PAD_GPIO_AD_B1_01.value, iomuxc::SW_PAD_CTL_PAD_GPIO_AD_B1_01.value,
                   iomuxc::LPI2C1_SDA_SELECT_INPUT.value}}) {
    if ((iomuxc_.setting(mux) & (kReadBack | 0xF)) != (kI2cFunction | kReadBack) ||
        iomuxc_.selection(source) != 1) {
      machine_.fail(
          {"LPI2C1 MTDR: a start while a pad or its input is not connected (IOMUXC: function 3, SION, "
           "selection 1)",
           Lpi2cProblem::not_connected});
      return false;
    }
    if ((iomuxc_.setting(pad) & kOpenDrain) == 0) {
      machine_.fail({"LPI2C1 MTDR: a start while a pad drives its line high (IOMUXC SW_PAD_CTL: ODE)",
                     Lpi2cProblem::not_open_drain});
      return false;
    }
  }
  return true;
}

Cycles Lpi2c::bit_time() const {
  const std::uint32_t shift = lpi2c::MCFGR1_PRESCALE.of(configuration1_);
  const std::uint32_t latency = (2 + lpi2c::MCFGR2_FILTSCL.of(configuration2_)) >> shift;
  const std::uint32_t clocks =
      (lpi2c::MCCR0_CLKLO.of(timing_) + 1 + lpi2c::MCCR0_CLKHI.of(timing_) + 1 + latency) << shift;
  return kCyclesPerSecond / clock_hz() * clocks;
}

void Lpi2c::check_timing() {
  const auto hz = static_cast<std::uint32_t>(kCyclesPerSecond / bit_time());
  if (hz > kFastMode_hz * 21 / 20)  // the rise of the lines, which is not modelled, makes it slower
    return machine_.fail({fmt::format("LPI2C1 MCCR0: {} Hz, the sensors take 400000", hz),
                          Lpi2cProblem::too_fast,
                          {std::to_string(hz)}});
  const std::uint32_t low_ns = static_cast<std::uint32_t>(
      1'000'000'000ULL *
      ((lpi2c::MCCR0_CLKLO.of(timing_) + 1ULL) << lpi2c::MCFGR1_PRESCALE.of(configuration1_)) / clock_hz());
  if (hz > 100'000 && low_ns < kFastModeLow_ns)
    machine_.fail({fmt::format("LPI2C1 MCCR0: the clock is low for {} ns, the bus wants 1300", low_ns),
                   Lpi2cProblem::low_too_short,
                   {std::to_string(low_ns)}});
}

/// Begins the next command unless something holds the bus.
void Lpi2c::go_on() {
  if (done_at_ != kNever || !enabled() || commands_.empty()) return;
  const std::uint32_t word = commands_.front();
  if (begin(word)) {
    commands_.pop_front();
    now_ = word;
  }
  machine_.wake(*this, done_at_);
}

bool Lpi2c::begin(std::uint32_t word) {
  const std::uint32_t command = lpi2c::MTDR_CMD.of(word);
  left_ = 0;
  if (command == kStart) {
    if ((events_ & kErrors) != 0) return false;
    if (!connected()) return false;
    check_timing();
    if (data_held() || clock_held_) {  // the bus is busy, as the controller sees it
      done_at_ = machine_.now() + kLookAgain;
      now_ = ~0U;
      return false;
    }
    ++starts_;
    done_at_ = machine_.now() + (kByteBits + 1) * bit_time();
    return true;
  }
  if (!owns_bus_) {
    if ((events_ & kErrors) == 0)
      machine_.fail({"LPI2C1 MTDR: a command without a start before it (FEF)", Lpi2cProblem::no_start});
    return false;
  }
  if (command == kReceive) left_ = static_cast<int>(lpi2c::MTDR_DATA.of(word)) + 1;
  done_at_ = machine_.now() + (command == kStop ? 2 : kByteBits) * bit_time();
  return true;
}

void Lpi2c::event() {
  if (done_at_ > machine_.now()) return machine_.wake(*this, done_at_);
  const bool waits = clock_held_ || (left_ > 0 && received_.size() == kQueue);
  if (waits || now_ == ~0U) {
    if (now_ == ~0U && !waits) {
      done_at_ = kNever;
      now_ = 0;
      return go_on();
    }
    done_at_ = machine_.now() + kLookAgain;
    return machine_.wake(*this, done_at_);
  }
  done_at_ = kNever;
  finish();
  go_on();
}

void Lpi2c::refuse() {
  events_ |= lpi2c::MSR_NDF.mask() | lpi2c::MSR_SDF.mask();  // it makes a stop by itself
  owns_bus_ = false;
  device_ = nullptr;
}

void Lpi2c::finish_start() {
  const std::uint32_t data = lpi2c::MTDR_DATA.of(now_);
  if (owns_bus_) events_ |= lpi2c::MSR_EPF.mask();
  owns_bus_ = true;
  reads_ = (data & 1) != 0;
  device_ = nullptr;
  for (I2cDevice* device : devices)
    if (device->addressed(static_cast<std::uint8_t>(data >> 1), reads_)) device_ = device;
  if (device_ == nullptr) refuse();
}

void Lpi2c::finish() {
  switch (lpi2c::MTDR_CMD.of(now_)) {
    case kStart:
      return finish_start();
    case kSend:
      if (!device_->write(static_cast<std::uint8_t>(lpi2c::MTDR_DATA.of(now_)))) refuse();
      return;
    case kReceive:
      received_.push_back(device_->read());
      if (--left_ > 0) done_at_ = machine_.now() + kByteBits * bit_time();
      if (done_at_ != kNever) machine_.wake(*this, done_at_);
      return;
    default:
      events_ |= lpi2c::MSR_SDF.mask() | lpi2c::MSR_EPF.mask();
      owns_bus_ = false;
      device_ = nullptr;
  }
}

std::uint32_t Lpi2c::read(std::uint32_t offset) {
  if (offset == lpi2c::MCR.value) return control_;
  if (offset == lpi2c::MSR.value)
    return events_ | lpi2c::MSR_TDF(commands_.empty()) | lpi2c::MSR_RDF(!received_.empty()) |
           lpi2c::MSR_MBF(owns_bus_) | lpi2c::MSR_BBF(owns_bus_ || data_held() || clock_held_);
  if (offset == lpi2c::MCFGR1.value) return configuration1_;
  if (offset == lpi2c::MCFGR2.value) return configuration2_;
  if (offset == lpi2c::MCCR0.value) return timing_;
  if (offset == lpi2c::MFSR.value)
    return lpi2c::MFSR_TXCOUNT(static_cast<std::uint32_t>(commands_.size())) |
           lpi2c::MFSR_RXCOUNT(static_cast<std::uint32_t>(received_.size()));
  if (offset == lpi2c::MRDR.value) {
    if (received_.empty()) {
      machine_.fail({"LPI2C1 MRDR: read while nothing has been received", Lpi2cProblem::nothing_received});
      return 0;
    }
    const std::uint8_t byte = received_.front();
    received_.pop_front();
    return byte;
  }
  return 0;
}

void Lpi2c::push(std::uint32_t word) {
  if (!enabled())
    return machine_.fail({"LPI2C1 MTDR: a command while the controller is off (MCR.MEN)", Lpi2cProblem::off});
  if (commands_.size() >= kQueue)
    return machine_.fail({"LPI2C1 MTDR: the queue of commands is full", Lpi2cProblem::queue_full});
  commands_.push_back(word);
  go_on();
}

void Lpi2c::flush(std::uint32_t control) {
  if (lpi2c::MCR_RTF.of(control) != 0) commands_.clear();
  if (lpi2c::MCR_RRF.of(control) != 0) received_.clear();
}

void Lpi2c::write(std::uint32_t offset, std::uint32_t value) {
  const bool setting =
      offset == lpi2c::MCFGR1.value || offset == lpi2c::MCFGR2.value || offset == lpi2c::MCCR0.value;
  if (enabled() && setting)
    machine_.fail({"LPI2C1: configured while the controller is on (MCR.MEN)", Lpi2cProblem::running});
  if (offset == lpi2c::MCR.value) {
    if (lpi2c::MCR_RST.of(value) != 0) {
      const std::uint32_t starts = starts_;
      reset();
      starts_ = starts;
    }
    flush(value);
    control_ = value & (lpi2c::MCR_MEN.mask() | lpi2c::MCR_RST.mask());
    if (!enabled()) {
      done_at_ = kNever;
      left_ = 0;
      owns_bus_ = false;
      device_ = nullptr;
      machine_.wake(*this, kNever);
    }
  }
  if (offset == lpi2c::MSR.value) {
    const bool errors = (events_ & kErrors) != 0;
    events_ &= ~(value & kI2cEvents);
    if (errors && (events_ & kErrors) == 0 && !commands_.empty())
      machine_.fail(
          {"LPI2C1 MSR: an error is cleared while commands of the transfer that failed are in the queue",
           Lpi2cProblem::left_in_queue});
  }
  if (offset == lpi2c::MCFGR1.value) configuration1_ = value;
  if (offset == lpi2c::MCFGR2.value) configuration2_ = value;
  if (offset == lpi2c::MCCR0.value) timing_ = value;
  if (offset == lpi2c::MTDR.value) push(value);
}

}  // namespace astro::emulator
