#include "host/emulator/chip/lpuart.hpp"

#include <algorithm>
#include <utility>

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr int kUartIrq = 25;
constexpr Cycles kTimeToRead =
    1000 * kCyclesPerMicrosecond;  // allowed to a handler that has just cleared IDLE
constexpr std::uint32_t kClearable = lpuart::STAT_OR.mask() | lpuart::STAT_IDLE.mask() |
                                     lpuart::STAT_NF.mask() | lpuart::STAT_FE.mask() | lpuart::STAT_PF.mask();

}  // namespace

void Lpuart::reset() {
  baud_ = 0x0F00'0004;
  control_ = fifo_ = water_ = events_ = 0;
  received_.clear();
  sending_.clear();
  incoming_.clear();
  arrives_at_ = departs_at_ = idle_at_ = found_by_ = kNever;
}

std::uint32_t Lpuart::baud() const {
  return ccm_.uart_hz() / ((lpuart::BAUD_OSR.of(baud_) + 1) * lpuart::BAUD_SBR.of(baud_));
}

/// Whether both pads belong to the port, and its input is selected.
bool Lpuart::connected() const {
  return iomuxc_.function(iomuxc::SW_MUX_CTL_PAD_GPIO_AD_B0_03.value) == 2 &&
         iomuxc_.function(iomuxc::SW_MUX_CTL_PAD_GPIO_AD_B0_02.value) == 2 &&
         iomuxc_.selection(iomuxc::LPUART6_RX_SELECT_INPUT.value) == 1;
}

void Lpuart::send(std::span<const std::uint8_t> bytes) {
  const bool idle = incoming_.empty();
  incoming_.insert(incoming_.end(), bytes.begin(), bytes.end());
  if (idle && !incoming_.empty()) {
    arrives_at_ = machine_.now() + byte_time();
    update();
  }
}

/// Without its FIFO enabled a direction holds one byte.
std::size_t Lpuart::capacity(Bits enable) const { return enable.of(fifo_) != 0 ? 4 : 1; }

std::vector<std::uint8_t> Lpuart::receive() { return std::exchange(outgoing_, {}); }

void Lpuart::arrive() {
  const std::uint8_t byte = incoming_.front();
  incoming_.pop_front();
  arrives_at_ = incoming_.empty() ? kNever : arrives_at_ + byte_time();
  if (lpuart::CTRL_RE.of(control_) == 0 || !connected()) return;
  idle_at_ = machine_.now() + byte_time();  // only a stored character arms the flag again
  if (received_.size() >= capacity(lpuart::FIFO_RXFE))
    return machine_.fail(
        {"LPUART6 DATA: overrun, the receiver's queue was not emptied", LpuartProblem::receiver_overrun});
  received_.push_back(byte);
}

void Lpuart::depart() {
  if (connected()) outgoing_.push_back(sending_.front());
  sending_.pop_front();
  departs_at_ = sending_.empty() ? kNever : departs_at_ + byte_time();
}

void Lpuart::event() {
  const Cycles now = machine_.now();
  if (arrives_at_ <= now) arrive();
  if (departs_at_ <= now && !held_) depart();
  if (idle_at_ <= now) {
    idle_at_ = kNever;
    if (lpuart::CTRL_RE.of(control_) != 0) events_ |= lpuart::STAT_IDLE.mask();
  }
  if (std::exchange(found_by_, found_by_ <= now ? kNever : found_by_) <= now)
    machine_.fail(
        {"LPUART6 STAT: IDLE was cleared while a character waits in the queue that no event will report",
         LpuartProblem::character_never_reported});
  update();
}

std::uint32_t Lpuart::status() const {
  const bool data = received_.size() > lpuart::WATER_RXWATER.of(water_);
  const bool room = sending_.size() <= lpuart::WATER_TXWATER.of(water_);
  return events_ | lpuart::STAT_RDRF(data) | lpuart::STAT_TDRE(room) | lpuart::STAT_TC(sending_.empty());
}

/// Whether characters wait below the watermark, and no event will report them.
bool Lpuart::stranded() const {
  const bool told =
      (status() & (lpuart::STAT_RDRF.mask() | lpuart::STAT_IDLE.mask())) != 0 || idle_at_ != kNever;
  return lpuart::CTRL_ILIE.of(control_) != 0 && !received_.empty() && !told;
}

void Lpuart::update() {
  if (!stranded())
    found_by_ = kNever;
  else if (found_by_ == kNever)
    found_by_ = machine_.now() + kTimeToRead;
  const std::uint32_t now = status();
  const bool level = (lpuart::CTRL_RIE.of(control_) != 0 && lpuart::STAT_RDRF.of(now) != 0) ||
                     (lpuart::CTRL_ILIE.of(control_) != 0 && lpuart::STAT_IDLE.of(now) != 0) ||
                     (lpuart::CTRL_ORIE.of(control_) != 0 && lpuart::STAT_OR.of(now) != 0) ||
                     (lpuart::CTRL_TIE.of(control_) != 0 && lpuart::STAT_TDRE.of(now) != 0) ||
                     (lpuart::CTRL_TCIE.of(control_) != 0 && lpuart::STAT_TC.of(now) != 0);
  machine_.set_interrupt(kUartIrq, level);
  machine_.wake(*this, std::min({arrives_at_, held_ ? kNever : departs_at_, idle_at_, found_by_}));
}

std::uint32_t Lpuart::read_data() {
  if (received_.empty()) {
    machine_.fail({"LPUART6 DATA: read while nothing has been received", LpuartProblem::nothing_received});
    return 0;
  }
  const std::uint8_t byte = received_.front();
  received_.pop_front();
  update();
  return byte;
}

std::uint32_t Lpuart::read(std::uint32_t offset) {
  machine_.wait(read_takes);
  if (offset == lpuart::PARAM.value) return 0x0202;
  if (offset == lpuart::BAUD.value) return baud_;
  if (offset == lpuart::STAT.value) return status();
  if (offset == lpuart::CTRL.value) return control_;
  if (offset == lpuart::DATA.value) return read_data();
  if (offset == lpuart::FIFO.value) return fifo_ | 0x11;
  if (offset == lpuart::WATER.value)
    return water_ | lpuart::WATER_TXCOUNT(static_cast<std::uint32_t>(sending_.size())) |
           lpuart::WATER_RXCOUNT(static_cast<std::uint32_t>(received_.size()));
  return 0;
}

void Lpuart::write_baud(std::uint32_t value) {
  const std::uint32_t ratio = lpuart::BAUD_OSR.of(value) + 1;
  if (ratio < 4 || (ratio < 8 && lpuart::BAUD_BOTHEDGE.of(value) == 0))
    return machine_.fail({"LPUART6 BAUD: fewer than 8 samples a bit need BOTHEDGE, fewer than 4 do not work",
                          LpuartProblem::too_few_samples,
                          {std::to_string(ratio)}});
  if (lpuart::BAUD_SBR.of(value) == 0)
    return machine_.fail({"LPUART6 BAUD: a divider SBR of 0 stops the port", LpuartProblem::divider_zero});
  baud_ = value;
}

void Lpuart::write_fifo(std::uint32_t value) {
  fifo_ = value & (lpuart::FIFO_RXFE.mask() | lpuart::FIFO_TXFE.mask());
  if (lpuart::FIFO_RXFLUSH.of(value) != 0) received_.clear();
  if (lpuart::FIFO_TXFLUSH.of(value) == 0) return;
  sending_.clear();
  departs_at_ = kNever;
}

void Lpuart::write_data(std::uint32_t value) {
  if (lpuart::CTRL_TE.of(control_) == 0)
    return machine_.fail({"LPUART6 DATA: sent while the transmitter is off", LpuartProblem::transmitter_off});
  if (sending_.size() >= capacity(lpuart::FIFO_TXFE))
    return machine_.fail(
        {"LPUART6 DATA: overrun, the transmitter's queue is full", LpuartProblem::transmitter_overrun});
  if (sending_.empty()) departs_at_ = machine_.now() + byte_time();
  sending_.push_back(static_cast<std::uint8_t>(value));
}

void Lpuart::write(std::uint32_t offset, std::uint32_t value) {
  const bool running = (control_ & (lpuart::CTRL_TE.mask() | lpuart::CTRL_RE.mask())) != 0;
  const bool setting =
      offset == lpuart::BAUD.value || offset == lpuart::FIFO.value || offset == lpuart::WATER.value;
  if (running && setting)
    machine_.fail(
        {"LPUART6: configured while transmitter or receiver runs (CTRL.TE, RE)", LpuartProblem::running});
  if (offset == lpuart::BAUD.value) write_baud(value);
  if (offset == lpuart::STAT.value) events_ &= ~(value & kClearable);
  if (offset == lpuart::CTRL.value) control_ = value;
  if (offset == lpuart::DATA.value) write_data(value);
  if (offset == lpuart::FIFO.value) write_fifo(value);
  if (offset == lpuart::WATER.value)
    water_ = value & (lpuart::WATER_TXWATER.mask() | lpuart::WATER_RXWATER.mask());
  update();
}

}  // namespace astro::emulator
