#include "hal/teensy40/usb/controller.hpp"

#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/registers/registers.hpp"
#include "hal/teensy40/usb/transfers.hpp"

namespace astro::teensy40 {

using usb_device::Events;
using usb_device::Pipe;
using usb_device::Setup;
using usb_device::Speed;

namespace {

using usb_device::kControlPacket;
using usb_device::kInEndpoint;
using usb_device::kNotifyEndpoint;
using usb_device::kNotifyPacket;
using usb_device::kOutEndpoint;

constexpr std::uint32_t kReads = 100'000;
/// Pipes of endpoints 0 to 4.
constexpr std::size_t kHeads = 10;
constexpr Pipe kControlOut{0, false}, kControlIn{0, true};

/// The controller takes the table's address without its lower 11 bits.
[[gnu::section(".usb.heads")]] alignas(2048) QueueHead heads[kHeads];
[[gnu::section(".usb.transfers")]] Transfer transfers[kHeads];
std::uint16_t sizes[kHeads];

std::uint32_t address_of(const void* object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object));
}

void start_pll() {
  using namespace ccm_analog;
  constexpr std::uint32_t kWanted = PLL_USB1_ENABLE(1) | PLL_USB1_POWER(1) | PLL_USB1_EN_USB_CLKS(1);
  CCM_ANALOG[PLL_USB1_SET].write(PLL_USB1_ENABLE(1) | PLL_USB1_POWER(1));
  static_cast<void>(poll(CCM_ANALOG[PLL_USB1], PLL_USB1_LOCK, 1, kReads));
  CCM_ANALOG[PLL_USB1_CLR].write(PLL_USB1_BYPASS(1));
  CCM_ANALOG[PLL_USB1_SET].write(kWanted);
}

/// The transceiver's own supply, 3.0 V.
void start_supply() {
  constexpr std::uint32_t kBrownOut = 6, kTarget = 15;
  PMU[pmu::REG_3P0].write(pmu::REG_3P0_ENABLE_LINREG(1) | pmu::REG_3P0_BO_OFFSET(kBrownOut) |
                          pmu::REG_3P0_OUTPUT_TRG(kTarget));
}

void start_transceiver() {
  USBPHY1[usbphy::CTRL_SET].write(usbphy::CTRL_SFTRST(1));
  USB1[usb::USBCMD].write(usb::USBCMD_RST(1));
  static_cast<void>(poll(USB1[usb::USBCMD], usb::USBCMD_RST, 0, kReads));
  USBPHY1[usbphy::CTRL_CLR].write(usbphy::CTRL_SFTRST(1));
  USBPHY1[usbphy::CTRL_CLR].write(usbphy::CTRL_CLKGATE(1));
  USBPHY1[usbphy::PWD].write(0);
}

void reset_heads() {
  for (QueueHead& head : heads) head = QueueHead{};
  heads[kControlOut.index()].capabilities = head_capabilities(kControlPacket, kInterruptOnSetup);
  heads[kControlIn.index()].capabilities = head_capabilities(kControlPacket, kNoEmptyPacket);
}

/// A packet in progress keeps its transfer despite a flush; then the flush is repeated.
void flush(std::uint32_t bits) {
  constexpr int kPackets = 4;
  for (int tries = 0; tries < kPackets; ++tries) {
    USB1[usb::ENDPTFLUSH].write(bits);
    for (std::uint32_t reads = kReads; reads != 0 && (USB1[usb::ENDPTFLUSH].read() & bits) != 0;) --reads;
    if ((USB1[usb::ENDPTSTAT].read() & bits) == 0) return;
  }
}

void drop(std::uint32_t bits) {
  flush(bits);
  USB1[usb::ENDPTCOMPLETE].write(bits);
}

Register<std::uint32_t> endpoint_control(std::uint32_t endpoint) {
  return Register<std::uint32_t>(USB1[usb::ENDPTCTRL0].address() + 4 * endpoint);
}

// Types of an endpoint; an unused direction must not stay of type "control".
constexpr std::uint32_t kBulk = 2, kInterruptType = 3;
constexpr std::uint32_t kReceive =
    usb::ENDPTCTRL1_RXE(1) | usb::ENDPTCTRL1_RXR(1) | usb::ENDPTCTRL1_RXT(kBulk) | usb::ENDPTCTRL1_TXT(kBulk);
constexpr std::uint32_t send_of(std::uint32_t type) {
  return usb::ENDPTCTRL1_TXE(1) | usb::ENDPTCTRL1_TXR(1) | usb::ENDPTCTRL1_TXT(type) |
         usb::ENDPTCTRL1_RXT(kBulk);
}
constexpr std::uint32_t kDataPipes =
    Pipe{kNotifyEndpoint, true}.bit() | Pipe{kOutEndpoint, false}.bit() | Pipe{kInEndpoint, true}.bit();
constexpr std::uint32_t kUnused = usb::ENDPTCTRL1_TXT(kBulk) | usb::ENDPTCTRL1_RXT(kBulk);

}  // namespace

void UsbController::start() {
  start_pll();
  start_supply();
  open_gate(CCM[ccm::CCGR6], ccm::CCGR6_CG0);
  start_transceiver();
  constexpr std::uint32_t kDeviceMode = 2;
  USB1[usb::USBMODE].write(usb::USBMODE_CM(kDeviceMode) | usb::USBMODE_SLOM(1));
  reset_heads();
  USB1[usb::ENDPTLISTADDR].write(address_of(heads));
  USB1[usb::USBSTS].write(~0U);
  USB1[usb::USBINTR].write(usb::USBINTR_UE(1) | usb::USBINTR_UEE(1) | usb::USBINTR_PCE(1) |
                           usb::USBINTR_URE(1) | usb::USBINTR_SLE(1));
  cpu::synchronize();
  USB1[usb::USBCMD].write(usb::USBCMD_RS(1));  // and no wait before an interrupt
}

void UsbController::detach() {
  USB1[usb::USBINTR].write(0);
  USB1[usb::USBCMD].write(0);
}

void UsbController::power_down() {
  open_gate(CCM[ccm::CCGR6], ccm::CCGR6_CG0);
  detach();
}

Events UsbController::take_events() {
  const std::uint32_t status = USB1[usb::USBSTS].read();
  USB1[usb::USBSTS].write(status);
  const bool suspended = USB1[usb::PORTSC1].get(usb::PORTSC1_SUSP) != 0;
  return {.reset = usb::USBSTS_URI.of(status) != 0,
          .suspended = usb::USBSTS_SLI.of(status) != 0 && suspended,
          .resumed = usb::USBSTS_PCI.of(status) != 0 && !suspended,
          .transfers = usb::USBSTS_UI.of(status) != 0};
}

bool UsbController::clean_up_after_reset() {
  USB1[usb::ENDPTSETUPSTAT].write(USB1[usb::ENDPTSETUPSTAT].read());
  USB1[usb::ENDPTCOMPLETE].write(USB1[usb::ENDPTCOMPLETE].read());
  for (std::uint32_t reads = kReads; reads != 0 && USB1[usb::ENDPTPRIME].read() != 0;) --reads;
  flush(~0U);
  const bool in_time = USB1[usb::PORTSC1].get(usb::PORTSC1_PR) != 0;
  close_endpoints();
  for (Transfer& transfer : transfers) transfer = Transfer{};
  USB1[usb::DEVICEADDR].write(0);
  return in_time;
}

Speed UsbController::speed() {
  return USB1[usb::PORTSC1].get(usb::PORTSC1_HSP) != 0 ? Speed::high : Speed::full;
}

void UsbController::set_address(std::uint8_t address) {
  USB1[usb::DEVICEADDR].write(usb::DEVICEADDR_USBADR(address) | usb::DEVICEADDR_USBADRA(1));
}

void UsbController::open_endpoints(Speed speed) {
  drop(kDataPipes);
  const std::uint32_t bulk = usb_device::bulk_packet(speed);
  heads[Pipe{kNotifyEndpoint, true}.index()].capabilities = head_capabilities(kNotifyPacket, kNoEmptyPacket);
  heads[Pipe{kOutEndpoint, false}.index()].capabilities = head_capabilities(bulk, kNoEmptyPacket);
  heads[Pipe{kInEndpoint, true}.index()].capabilities = head_capabilities(bulk, 0);
  endpoint_control(kNotifyEndpoint).write(send_of(kInterruptType));
  endpoint_control(kOutEndpoint).write(kReceive);
  endpoint_control(kInEndpoint).write(send_of(kBulk));
}

void UsbController::close_endpoints() {
  drop(kDataPipes);
  for (const std::uint32_t endpoint : {kNotifyEndpoint, kOutEndpoint, kInEndpoint})
    endpoint_control(endpoint).write(kUnused);
}

void UsbController::stall(Pipe pipe) {
  endpoint_control(pipe.endpoint).modify(0, pipe.in ? usb::ENDPTCTRL1_TXS(1) : usb::ENDPTCTRL1_RXS(1));
}

void UsbController::unstall(Pipe pipe) {
  const std::uint32_t stalled = pipe.in ? usb::ENDPTCTRL1_TXS(1) : usb::ENDPTCTRL1_RXS(1);
  const std::uint32_t toggle = pipe.in ? usb::ENDPTCTRL1_TXR(1) : usb::ENDPTCTRL1_RXR(1);
  endpoint_control(pipe.endpoint).modify(stalled, toggle);
}

/// The next SETUP packet ends it by itself.
void UsbController::stall_control() {
  USB1[usb::ENDPTCTRL0].modify(0, usb::ENDPTCTRL0_RXS(1) | usb::ENDPTCTRL0_TXS(1));
}

bool UsbController::setup_waits() { return (USB1[usb::ENDPTSETUPSTAT].read() & 1U) != 0; }

bool UsbController::take_setup(Setup& setup) {
  constexpr std::uint32_t kEndpoint0 = 1;
  if (!setup_waits()) return false;
  USB1[usb::ENDPTSETUPSTAT].write(kEndpoint0);
  const volatile std::uint32_t* words = heads[kControlOut.index()].setup;
  for (std::uint32_t reads = kReads; reads != 0; --reads) {
    // A SETUP packet that arrives while the last one is copied clears the tripwire.
    USB1[usb::USBCMD].modify(0, usb::USBCMD_SUTW(1));
    setup = usb_device::make_setup(words[0], words[1]);
    if (USB1[usb::USBCMD].get(usb::USBCMD_SUTW) != 0) break;
  }
  USB1[usb::USBCMD].modify(usb::USBCMD_SUTW(1), 0);
  // The end of the last stage of an earlier request must not be taken for this request's.
  drop(kControlOut.bit() | kControlIn.bit());
  return true;
}

void UsbController::begin(Pipe pipe, std::span<std::uint8_t> bytes) {
  const std::uint32_t index = pipe.index();
  Transfer& transfer = transfers[index];
  QueueHead& head = heads[index];
  sizes[index] = static_cast<std::uint16_t>(bytes.size());
  transfer.next = kEnd;
  transfer.token = static_cast<std::uint32_t>(bytes.size()) << 16 | kInterruptWhenDone | kActive;
  std::uint32_t address = address_of(bytes.data());
  for (std::uint32_t& page : transfer.pages) {
    page = address;
    address = (address & ~0xFFFU) + 0x1000;
  }
  head.next = address_of(&transfer);
  head.token &= ~(kActive | kHalted);
  cpu::synchronize();
  USB1[usb::ENDPTPRIME].write(pipe.bit());
  for (std::uint32_t reads = kReads; reads != 0 && (USB1[usb::ENDPTPRIME].read() & pipe.bit()) != 0;) --reads;
}

void UsbController::cancel(Pipe pipe) { drop(pipe.bit()); }

std::uint32_t UsbController::take_completed() {
  const std::uint32_t pipes = USB1[usb::ENDPTCOMPLETE].read();
  USB1[usb::ENDPTCOMPLETE].write(pipes);
  return pipes;
}

std::size_t UsbController::moved(Pipe pipe) {
  const volatile Transfer& transfer = transfers[pipe.index()];
  return sizes[pipe.index()] - (transfer.token >> 16 & 0x7FFF);
}

}  // namespace astro::teensy40
