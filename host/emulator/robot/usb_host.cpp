#include "host/emulator/robot/usb_host.hpp"

#include <algorithm>

#include "common/base/little_endian.hpp"

namespace astro::emulator {
namespace {

using namespace std::chrono_literals;

constexpr auto kMicroframe = 125us;
constexpr int kNakRetries = 4000;  // one per microframe: half a second, the usual time-out of a host

std::array<std::uint8_t, 8> bytes_of(const UsbHost::Request& r) {
  std::array<std::uint8_t, 8> bytes{r.type, r.request};
  store_little_endian(&bytes[2], r.value);
  store_little_endian(&bytes[4], r.index);
  store_little_endian(&bytes[6], r.length);
  return bytes;
}

}  // namespace

void UsbHost::reset(bool high_speed) {
  teensy_.usb().begin_reset();
  teensy_.run_for(10ms);
  teensy_.usb().end_reset(high_speed);
  bulk_packet_ = high_speed ? 512 : 64;
  address_ = 0;
  reset_toggles();
  teensy_.run_for(1ms);
}

void UsbHost::suspend() {
  teensy_.run_for(3ms);
  teensy_.usb().suspend();
  teensy_.run_for(1ms);
}

void UsbHost::resume() {
  teensy_.usb().resume();
  teensy_.run_for(20ms);
}

Handshake UsbHost::retry_nak(const std::function<Handshake()>& transaction) {
  Handshake answer = Handshake::nak;
  for (int i = 0; i < kNakRetries && answer == Handshake::nak; ++i) {
    answer = transaction();
    teensy_.run_for(kMicroframe);
  }
  return answer;
}

Packet UsbHost::in_with_retries(int endpoint) {
  Packet packet;
  packet.handshake = retry_nak([&] {
    packet = teensy_.usb().in(address_, endpoint);
    return packet.handshake;
  });
  return packet;
}

Handshake UsbHost::setup_only(const Request& request) {
  const Handshake answer = teensy_.usb().setup(address_, bytes_of(request));
  teensy_.run_for(kMicroframe);
  return answer;
}

UsbHost::Outcome UsbHost::read(const Request& request, std::vector<std::uint8_t>& data) {
  data.clear();
  if (setup_only(request) != Handshake::ack) return Outcome::no_answer;
  bool data1 = true;
  while (data.size() < request.length) {
    const Packet packet = in_with_retries(0);
    if (packet.handshake == Handshake::stall) return Outcome::stalled;
    if (packet.handshake != Handshake::ack || packet.data1 != data1) return Outcome::no_answer;
    data1 = !data1;
    data.insert(data.end(), packet.bytes.begin(), packet.bytes.end());
    if (packet.bytes.size() < packet_) break;
  }
  const Handshake status = retry_nak([&] { return teensy_.usb().out(address_, 0, {}, true); });
  if (status == Handshake::stall) return Outcome::stalled;
  return status == Handshake::ack ? Outcome::done : Outcome::no_answer;
}

UsbHost::Outcome UsbHost::write(const Request& request, std::span<const std::uint8_t> data) {
  if (setup_only(request) != Handshake::ack) return Outcome::no_answer;
  bool data1 = true;
  for (std::size_t at = 0; at < data.size(); at += packet_) {
    const auto part = data.subspan(at, std::min<std::size_t>(packet_, data.size() - at));
    const Handshake answer = retry_nak([&] { return teensy_.usb().out(address_, 0, part, data1); });
    if (answer != Handshake::ack) return answer == Handshake::stall ? Outcome::stalled : Outcome::no_answer;
    data1 = !data1;
  }
  const Packet status = in_with_retries(0);
  if (status.handshake == Handshake::stall) return Outcome::stalled;
  const bool right = status.handshake == Handshake::ack && status.bytes.empty() && status.data1;
  if (!right) return Outcome::no_answer;
  follow(request);
  return Outcome::done;
}

/// Resets the data toggles after a request that makes both sides begin with DATA0 again.
void UsbHost::follow(const Request& request) {
  constexpr std::uint8_t kClearFeature = 1, kSetConfiguration = 9, kSetInterface = 11;
  if (request.type == 0x00 && request.request == kSetConfiguration) reset_toggles();
  if (request.type == 0x01 && request.request == kSetInterface) reset_toggles();
  if (request.type != 0x02 || request.request != kClearFeature) return;
  auto& toggles = (request.index & 0x80) != 0 ? in_data1_ : out_data1_;
  toggles[request.index & 0xFU] = false;
}

void UsbHost::reset_toggles() { out_data1_ = in_data1_ = {}; }

UsbHost::Outcome UsbHost::set_address(std::uint8_t address) {
  const Outcome outcome = write({0x00, 5, address, 0, 0});
  if (outcome == Outcome::done) address_ = address;
  return outcome;
}

bool UsbHost::send(int endpoint, std::span<const std::uint8_t> bytes, std::chrono::microseconds limit) {
  bool& data1 = out_data1_[static_cast<std::size_t>(endpoint)];
  const Cycles end = teensy_.now() + static_cast<Cycles>(limit.count()) * kCyclesPerMicrosecond;
  for (std::size_t at = 0; at < bytes.size() || bytes.empty();) {
    const auto part = bytes.subspan(at, std::min<std::size_t>(bulk_packet_, bytes.size() - at));
    const Handshake answer = teensy_.usb().out(address_, endpoint, part, data1);
    if (answer == Handshake::ack) {
      data1 = !data1;
      at += part.size();
      if (bytes.empty()) return true;
    } else if (answer != Handshake::nak || teensy_.now() >= end) {
      return false;
    }
    teensy_.run_for(kMicroframe);
  }
  return true;
}

std::optional<Packet> UsbHost::receive(int endpoint, std::chrono::microseconds limit) {
  const Cycles end = teensy_.now() + static_cast<Cycles>(limit.count()) * kCyclesPerMicrosecond;
  while (true) {
    Packet packet = teensy_.usb().in(address_, endpoint);
    if (packet.handshake == Handshake::ack) {
      bool& data1 = in_data1_[static_cast<std::size_t>(endpoint)];
      const bool fresh = packet.data1 == data1;
      data1 = !packet.data1;
      if (fresh) return packet;
    } else if (packet.handshake != Handshake::nak) {
      return packet;
    }
    if (teensy_.now() >= end) return {};
    teensy_.run_for(kMicroframe);
  }
}

}  // namespace astro::emulator
