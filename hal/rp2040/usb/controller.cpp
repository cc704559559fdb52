#include "hal/rp2040/usb/controller.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/registers/registers.hpp"

namespace astro::rp2040 {

using usb_device::Events;
using usb_device::Pipe;
using usb_device::Setup;
using usb_device::Speed;

namespace {

constexpr std::uint32_t kPacket = usb_device::bulk_packet(Speed::full);
static_assert(kPacket == usb_device::kControlPacket);
constexpr Pipe kControlOut{0, false}, kControlIn{0, true};
constexpr Pipe kNotify{usb_device::kNotifyEndpoint, true}, kOut{usb_device::kOutEndpoint, false},
    kIn{usb_device::kInEndpoint, true};
constexpr std::array kControlPipes{kControlIn, kControlOut};
constexpr std::array kDataPipes{kNotify, kOut, kIn};
constexpr std::array kPipes{kControlIn, kControlOut, kNotify, kOut, kIn};

struct Transfer {
  std::uint8_t* bytes = nullptr;
  std::size_t size = 0, moved = 0;
  std::size_t packet = 0;  // bytes in the packet that lies ready for the host
  bool under_way = false;
  bool data1 = false;  // the next packet's toggle
  bool halted = false;
};

std::array<Transfer, 10> transfers;  // of endpoints 0 to 4
std::uint32_t ended = 0;             // pipes whose transfers have ended, not taken yet
std::uint8_t next_address = 0;       // in force once the host has taken the status stage; 0: none

Transfer& of(Pipe pipe) { return transfers[pipe.index()]; }

/// This chip counts an endpoint's direction towards the host first.
constexpr std::uint32_t place(Pipe pipe) { return 2 * pipe.endpoint + (pipe.in ? 0 : 1); }
constexpr std::uint32_t status_bit(Pipe pipe) { return 1U << place(pipe); }
Register buffer_control(Pipe pipe) {
  return USBCTRL_DPRAM.at(usb_dpram::EP0_IN_BUFFER_CONTROL, place(pipe), 4);
}
Register endpoint_control(Pipe pipe) {
  return USBCTRL_DPRAM.at(usb_dpram::EP1_IN_CONTROL, place(pipe) - 2, 4);
}
/// Each data endpoint has one direction, so each has one buffer. Both directions of endpoint 0 share theirs.
Register buffer(Pipe pipe) {
  return pipe.endpoint == 0
             ? USBCTRL_DPRAM[usb_dpram::EP0_BUFFER]
             : USBCTRL_DPRAM.at(usb_dpram::BUFFERS, pipe.endpoint - usb_device::kNotifyEndpoint, kPacket);
}

void fill_buffer(Register into, const std::uint8_t* bytes, std::size_t size) {
  for (std::size_t at = 0; at < size; at += 4) {
    std::uint32_t word = 0;
    for (std::size_t i = std::min<std::size_t>(size - at, 4); i-- != 0;) word = word << 8 | bytes[at + i];
    Register(into.address() + static_cast<std::uint32_t>(at)).write(word);
  }
}

void empty_buffer(Register from, std::uint8_t* bytes, std::size_t size) {
  for (std::size_t at = 0; at < size; at += 4) {
    std::uint32_t word = Register(from.address() + static_cast<std::uint32_t>(at)).read();
    for (std::size_t i = 0; i < 4 && at + i < size; ++i, word >>= 8)
      bytes[at + i] = static_cast<std::uint8_t>(word);
  }
}

/// The controller's slower clock may see half of a word that changes. So what tells it to act comes later than the rest, by
/// more than one of its clocks (data sheet, 4.1.2.5.1).
void write_then_add(Register control, std::uint32_t word, std::uint32_t act) {
  control.write(word);
  asm volatile("nop\n nop\n nop\n nop\n nop\n nop" ::: "memory");
  control.write(word | act);
}

/// Gives the next packet's buffer to the controller.
void arm(Pipe pipe) {
  using namespace usb_dpram;  // NOLINT(google-build-using-namespace): this function is all fields of one word
  Transfer& transfer = of(pipe);
  if (transfer.halted) return;
  std::uint32_t word = EP0_IN_BUFFER_CONTROL_PID_0(transfer.data1 ? 1 : 0);
  if (pipe.in) {
    transfer.packet = std::min<std::size_t>(transfer.size - transfer.moved, kPacket);
    fill_buffer(buffer(pipe), transfer.bytes + transfer.moved, transfer.packet);
    word |= EP0_IN_BUFFER_CONTROL_FULL_0(1) |
            EP0_IN_BUFFER_CONTROL_LENGTH_0(static_cast<std::uint32_t>(transfer.packet));
  } else {
    word |= EP0_IN_BUFFER_CONTROL_LENGTH_0(kPacket);
  }
  write_then_add(buffer_control(pipe), word, EP0_IN_BUFFER_CONTROL_AVAILABLE_0(1));
}

void receive_packet(Pipe pipe, Transfer& transfer) {
  const std::uint32_t arrived = buffer_control(pipe).get(usb_dpram::EP0_IN_BUFFER_CONTROL_LENGTH_0);
  transfer.packet = std::min<std::size_t>(arrived, transfer.size - transfer.moved);
  empty_buffer(buffer(pipe), transfer.bytes + transfer.moved, transfer.packet);
}

/// The controller has used the buffer of a pipe. True if the transfer has ended with it.
bool packet_done(Pipe pipe) {
  Transfer& transfer = of(pipe);
  transfer.data1 = !transfer.data1;
  if (!transfer.under_way) return false;
  if (!pipe.in) receive_packet(pipe, transfer);
  transfer.moved += transfer.packet;
  const bool full = transfer.packet == kPacket;
  const bool empty_one_follows = pipe.in && pipe.endpoint != 0 && full;
  const bool more = (transfer.moved < transfer.size && full) || empty_one_follows;
  if (more) arm(pipe);
  transfer.under_way = more;
  return !more;
}

/// Takes a buffer back that the controller has. Abort bits of the controller exist for this, but with them the first chips
/// refuse everything for ever (erratum RP2040-E2). So the driver takes it, and waits longer than the longest packet with its
/// handshake, 62 us: if the host was fetching it, that has ended like any other packet.
void take_back(Pipe pipe) {
  const Register control = buffer_control(pipe);
  if (control.get(usb_dpram::EP0_IN_BUFFER_CONTROL_AVAILABLE_0) != 0) {
    constexpr std::uint32_t kPacket_us = 70;
    control.write(control.read() & ~usb_dpram::EP0_IN_BUFFER_CONTROL_AVAILABLE_0.mask());
    const std::uint64_t begun_us = UsbController::now_us();
    while (UsbController::now_us() - begun_us < kPacket_us) {
    }
  }
  if ((USBCTRL[usb::BUFF_STATUS].read() & status_bit(pipe)) == 0) return;
  USBCTRL[usb::BUFF_STATUS].write(status_bit(pipe));
  if (packet_done(pipe)) ended |= pipe.bit();
}

void forget(Pipe pipe) {
  buffer_control(pipe).write(0);
  USBCTRL[usb::BUFF_STATUS].write(status_bit(pipe));
  ended &= ~pipe.bit();
  of(pipe) = Transfer{};
}

void take_address() {
  if (next_address == 0) return;
  USBCTRL[usb::ADDR_ENDP].write(next_address);
  next_address = 0;
}

}  // namespace

void UsbController::power_down() { RESETS[resets::RESET].set(resets::RESET_USBCTRL.mask()); }

void UsbController::start() {
  wake(resets::RESET_USBCTRL.mask());
  constexpr std::uint32_t kControlWords = 0x100 / 4;
  for (std::uint32_t i = 0; i < kControlWords; ++i)
    USBCTRL_DPRAM.at(usb_dpram::SETUP_PACKET_LOW, i, 4).write(0);
  transfers = {};
  ended = 0;
  next_address = 0;
  USBCTRL[usb::USB_MUXING].write(usb::USB_MUXING_TO_PHY(1) | usb::USB_MUXING_SOFTCON(1));
  // No pin of a Pico tells the controller whether the cable is in.
  USBCTRL[usb::USB_PWR].write(usb::USB_PWR_VBUS_DETECT(1) | usb::USB_PWR_VBUS_DETECT_OVERRIDE_EN(1));
  USBCTRL[usb::MAIN_CTRL].write(usb::MAIN_CTRL_CONTROLLER_EN(1));
  USBCTRL[usb::INTE].write(usb::INTE_BUFF_STATUS(1) | usb::INTE_BUS_RESET(1) | usb::INTE_DEV_SUSPEND(1) |
                           usb::INTE_DEV_RESUME_FROM_HOST(1) | usb::INTE_SETUP_REQ(1));
  USBCTRL[usb::SIE_CTRL].write(usb::SIE_CTRL_EP0_INT_1BUF(1) | usb::SIE_CTRL_PULLUP_EN(1));
}

Events UsbController::take_events() {
  constexpr std::uint32_t kTaken =
      usb::SIE_STATUS_BUS_RESET(1) | usb::SIE_STATUS_SUSPENDED(1) | usb::SIE_STATUS_RESUME(1);
  const std::uint32_t status = USBCTRL[usb::SIE_STATUS].read();
  USBCTRL[usb::SIE_STATUS].write(status & kTaken);
  const bool transfers_wait =
      usb::SIE_STATUS_SETUP_REC.of(status) != 0 || USBCTRL[usb::BUFF_STATUS].read() != 0;
  const bool suspended = usb::SIE_STATUS_SUSPENDED.of(status) != 0;
  // A host that moves bytes is awake, whether or not its wish to resume was noticed.
  return {.reset = usb::SIE_STATUS_BUS_RESET.of(status) != 0,
          .suspended = suspended,
          .resumed = usb::SIE_STATUS_RESUME.of(status) != 0 || (transfers_wait && !suspended),
          .transfers = transfers_wait};
}

/// Always in time: a reset takes 10 ms, and nothing holds this interrupt for as long.
bool UsbController::clean_up_after_reset() {
  USBCTRL[usb::ADDR_ENDP].write(0);
  next_address = 0;
  USBCTRL[usb::SIE_STATUS].write(usb::SIE_STATUS_SETUP_REC(1));
  USBCTRL[usb::EP_STALL_ARM].write(0);
  for (const Pipe pipe : kControlPipes) forget(pipe);
  close_endpoints();
  return true;
}

void UsbController::set_address(std::uint8_t address) {
  next_address = address;
  if (address == 0) USBCTRL[usb::ADDR_ENDP].write(0);
}

void UsbController::open_endpoints(Speed) {
  constexpr std::uint32_t kBulk = 2, kInterruptType = 3;
  using namespace usb_dpram;  // NOLINT(google-build-using-namespace): this function is all fields of one word
  for (const Pipe pipe : kDataPipes) {
    take_back(pipe);
    forget(pipe);
    endpoint_control(pipe).write(
        EP1_IN_CONTROL_ENABLE(1) | EP1_IN_CONTROL_INTERRUPT_PER_BUFF(1) |
        EP1_IN_CONTROL_ENDPOINT_TYPE(pipe.endpoint == usb_device::kNotifyEndpoint ? kInterruptType : kBulk) |
        EP1_IN_CONTROL_BUFFER_ADDRESS(buffer(pipe).address() - USBCTRL_DPRAM.base));
  }
}

void UsbController::close_endpoints() {
  for (const Pipe pipe : kDataPipes) {
    endpoint_control(pipe).write(0);
    take_back(pipe);
    forget(pipe);
  }
}

void UsbController::stall(Pipe pipe) {
  of(pipe).halted = true;
  take_back(pipe);
  write_then_add(buffer_control(pipe), 0, usb_dpram::EP0_IN_BUFFER_CONTROL_STALL(1));
}

/// A transfer that was under way goes on, with the packet that the host has not had.
void UsbController::unstall(Pipe pipe) {
  take_back(pipe);
  buffer_control(pipe).write(0);
  of(pipe).halted = false;
  of(pipe).data1 = false;
  if (of(pipe).under_way) arm(pipe);
}

void UsbController::stall_control() {
  USBCTRL[usb::EP_STALL_ARM].write(usb::EP_STALL_ARM_EP0_IN(1) | usb::EP_STALL_ARM_EP0_OUT(1));
  for (const Pipe pipe : kControlPipes)
    write_then_add(buffer_control(pipe), 0, usb_dpram::EP0_IN_BUFFER_CONTROL_STALL(1));
}

bool UsbController::setup_waits() { return USBCTRL[usb::SIE_STATUS].get(usb::SIE_STATUS_SETUP_REC) != 0; }

bool UsbController::take_setup(Setup& setup) {
  if (!setup_waits()) return false;
  // The host may have taken the status stage of SET_ADDRESS just before.
  if ((USBCTRL[usb::BUFF_STATUS].read() & status_bit(kControlIn)) != 0) take_address();
  do {  // once more if another one has come meanwhile
    USBCTRL[usb::SIE_STATUS].write(usb::SIE_STATUS_SETUP_REC(1));
    setup = usb_device::make_setup(USBCTRL_DPRAM[usb_dpram::SETUP_PACKET_LOW].read(),
                                   USBCTRL_DPRAM[usb_dpram::SETUP_PACKET_HIGH].read());
  } while (setup_waits());
  next_address = 0;
  for (const Pipe pipe : kControlPipes) {
    forget(pipe);
    of(pipe).data1 = true;  // of every stage after a SETUP packet
  }
  return true;
}

void UsbController::begin(Pipe pipe, std::span<std::uint8_t> bytes) {
  Transfer& transfer = of(pipe);
  transfer.bytes = bytes.data();
  transfer.size = bytes.size();
  transfer.moved = 0;
  transfer.under_way = true;
  arm(pipe);
}

void UsbController::cancel(Pipe pipe) {
  of(pipe).under_way = false;
  take_back(pipe);
  ended &= ~pipe.bit();
}

std::uint32_t UsbController::take_completed() {
  const std::uint32_t done = USBCTRL[usb::BUFF_STATUS].read();
  USBCTRL[usb::BUFF_STATUS].write(done);
  for (const Pipe pipe : kPipes) {
    if ((done & status_bit(pipe)) == 0) continue;
    if (pipe.endpoint == 0 && setup_waits()) continue;  // it belongs to a request that the host has given up
    if (pipe.bit() == kControlIn.bit()) take_address();
    if (packet_done(pipe)) ended |= pipe.bit();
  }
  return std::exchange(ended, 0U);
}

std::size_t UsbController::moved(Pipe pipe) { return of(pipe).moved; }

}  // namespace astro::rp2040
