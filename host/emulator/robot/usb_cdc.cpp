#include "host/emulator/robot/usb_cdc.hpp"

#include <algorithm>
#include <utility>

#include "common/base/little_endian.hpp"
#include "host/base/error.hpp"

namespace astro::emulator {
namespace {

using namespace std::chrono_literals;
using Outcome = UsbHost::Outcome;

constexpr std::uint8_t kRobotAddress = 1;
constexpr std::uint8_t kInterface = 4, kEndpoint = 5, kConfiguration = 2;  // kinds of descriptors
constexpr std::uint8_t kCommunication = 2, kData = 0x0A;                   // classes of interfaces
constexpr std::uint8_t kGetDescriptor = 6, kSetConfiguration = 9, kSetLineCoding = 0x20,
                       kSetControlLineState = 0x22;
constexpr std::uint8_t kToInterface = 0x21;
constexpr int kPacketsPerStep = 8, kMicroframesToDrain = 800;  // a tenth of a second

}  // namespace

void CdcHost::expect(bool fulfilled, const char* what) {
  if (fulfilled) return;
  if (!teensy_.usb().attached()) throw Detached{};
  throw Error(std::string("the USB device ") + what);
}

template <class Work>
void CdcHost::while_attached(Work work) {
  try {
    work();
  } catch (const Detached&) {
    present_ = false;
  }
}

CdcHost::Pipes CdcHost::pipes_of(std::span<const std::uint8_t> configuration) {
  Pipes pipes;
  std::uint8_t interface_class = 0;
  for (std::size_t at = 0; at + 2 <= configuration.size() && configuration[at] >= 2;
       at += configuration[at]) {
    const auto descriptor = configuration.subspan(at);
    if (descriptor[1] == kInterface) {
      interface_class = descriptor[5];
      if (interface_class == kCommunication) pipes.control_interface = descriptor[2];
    }
    if (descriptor[1] == kEndpoint && interface_class == kData)
      ((descriptor[2] & 0x80) != 0 ? pipes.in : pipes.out) = descriptor[2] & 0x0F;
  }
  expect(pipes.in != 0 && pipes.out != 0, "is no serial port");
  return pipes;
}

void CdcHost::enumerate() {
  host_.reset();
  expect(host_.set_address(kRobotAddress) == Outcome::done, "takes no address");
  teensy_.run_for(2ms);  // the time that a device may take for it
  std::vector<std::uint8_t> configuration;
  const auto read = [&](std::uint16_t bytes) {
    return host_.read({0x80, kGetDescriptor, kConfiguration << 8, 0, bytes}, configuration);
  };
  expect(read(9) == Outcome::done && configuration.size() == 9, "has no configuration");
  const auto total = load_little_endian<std::uint16_t>(&configuration[2]);
  expect(read(total) == Outcome::done && configuration.size() == total, "cuts its configuration short");
  pipes_ = pipes_of(configuration);
  expect(host_.write({0x00, kSetConfiguration, configuration[5], 0, 0}) == Outcome::done,
         "cannot be configured");
  present_ = true;
  if (open_) set_line();
}

void CdcHost::set_line() {
  std::array<std::uint8_t, 7> coding{0, 0, 0, 0, 0, 0, 8};  // baud; one stop bit, no parity, eight bits
  store_little_endian<std::uint32_t>(coding.data(), baud_);
  constexpr std::uint16_t kReadyAndCarrier = 3;
  const std::uint16_t interface = pipes_.control_interface;
  expect(host_.write({kToInterface, kSetLineCoding, 0, interface, 7}, coding) == Outcome::done,
         "refuses the line coding");
  const std::uint16_t state = open_ ? kReadyAndCarrier : 0;
  expect(host_.write({kToInterface, kSetControlLineState, state, interface, 0}) == Outcome::done,
         "refuses the line state");
}

void CdcHost::open(std::uint32_t baud) {
  if (open_ && baud == baud_) return;
  open_ = true;
  baud_ = baud;
  if (present_) while_attached([this] { set_line(); });
}

/// Bytes written before are sent first, up to a time limit, as an operating system does it.
void CdcHost::close() {
  if (!open_) return;
  for (int i = 0; i < kMicroframesToDrain && present_ && !to_device_.empty(); ++i) {
    send_bytes();
    teensy_.run_for(125us);
  }
  open_ = false;
  to_device_.clear();
  received_.clear();
  if (present_) while_attached([this] { set_line(); });
}

void CdcHost::send_bytes() {
  for (int i = 0; i < kPacketsPerStep && !to_device_.empty(); ++i) {
    const std::size_t count = std::min<std::size_t>(to_device_.size(), host_.bulk_packet());
    const std::vector<std::uint8_t> packet(to_device_.begin(),
                                           to_device_.begin() + static_cast<std::ptrdiff_t>(count));
    if (!host_.send(pipes_.out, packet, 0us)) break;  // it has no room now
    to_device_.erase(to_device_.begin(), to_device_.begin() + static_cast<std::ptrdiff_t>(count));
  }
}

void CdcHost::take_bytes() {
  for (int i = 0; i < kPacketsPerStep; ++i) {
    const auto packet = host_.receive(pipes_.in, 0us);
    if (!packet || packet->handshake != Handshake::ack) break;
    received_.insert(received_.end(), packet->bytes.begin(), packet->bytes.end());
  }
}

void CdcHost::step() {
  if (!teensy_.usb().attached()) {
    present_ = false;
    to_device_.clear();
    return;
  }
  if (!present_) while_attached([this] { enumerate(); });
  if (!present_ || !open_) return;
  send_bytes();
  take_bytes();
}

}  // namespace astro::emulator
