#include "hal/usb/control.hpp"

#include <algorithm>
#include <utility>

#include "common/base/little_endian.hpp"

namespace astro::usb_device {
namespace {

namespace request {
constexpr std::uint8_t kGetStatus = 0, kClearFeature = 1, kSetFeature = 3, kSetAddress = 5,
                       kGetDescriptor = 6, kGetConfiguration = 8, kSetConfiguration = 9, kGetInterface = 10,
                       kSetInterface = 11;
constexpr std::uint8_t kSetLineCoding = 0x20, kGetLineCoding = 0x21, kSetControlLineState = 0x22,
                       kSendBreak = 0x23;
}  // namespace request

constexpr std::uint8_t kTypeMask = 0x60, kStandard = 0x00, kClass = 0x20;
constexpr std::uint8_t kRecipientMask = 0x1F, kDeviceRecipient = 0, kInterfaceRecipient = 1,
                       kEndpointRecipient = 2;
constexpr std::uint16_t kHalt = 0, kSelfPowered = 1, kInterfaces = 2;
constexpr std::size_t kLineCodingBytes = 7;

}  // namespace

void Control::on_reset() {
  address_ = configuration_ = halted_ = 0;
  line_state_ = 0;
  changes_ = {};
}

Control::Changes Control::take_changes() { return std::exchange(changes_, {}); }

bool Control::exists(std::uint8_t endpoint) {
  return endpoint == (0x80 | kNotifyEndpoint) || endpoint == kOutEndpoint || endpoint == (0x80 | kInEndpoint);
}

std::uint8_t Control::bit(std::uint8_t endpoint) { return static_cast<std::uint8_t>(1U << (endpoint & 7)); }

// A reply that is shorter than the host has asked for and ends with a full packet would need an empty packet
// after it. No reply does, because the size of none is a multiple of a packet.
constexpr bool ends_by_itself(std::size_t bytes) { return bytes % kControlPacket != 0; }
static_assert(ends_by_itself(device(Identity{}).size()) && ends_by_itself(kQualifier.size()) &&
              ends_by_itself(kConfigurationBytes) && ends_by_itself(kLanguages.size()) &&
              ends_by_itself(StringDescriptor(kManufacturer).size) &&
              ends_by_itself(StringDescriptor(kProduct).size) && ends_by_itself(kStringBytes));

/// Sends from a buffer in data memory: constants may be in memory that the controller cannot read.
Response Control::send(std::span<const std::uint8_t> all, const Setup& setup) {
  if (all.data() != reply_.data()) std::copy(all.begin(), all.end(), reply_.begin());
  const std::size_t size = std::min<std::size_t>(all.size(), setup.length);
  return {.kind = Response::Kind::send, .data = std::span<const std::uint8_t>(reply_).first(size)};
}

Response Control::send_small(const Setup& setup, std::uint16_t value, std::size_t bytes) {
  reply_[0] = low(value);
  reply_[1] = high(value);
  return send(std::span(reply_).first(bytes), setup);
}

Response Control::on_setup(const Setup& setup, Speed speed) {
  if ((setup.type & kTypeMask) == kStandard) return standard(setup, speed);
  if ((setup.type & kTypeMask) == kClass) return of_class(setup);
  return {};
}

Response Control::standard(const Setup& setup, Speed speed) {
  switch (setup.type & kRecipientMask) {
    case kDeviceRecipient:
      return of_device(setup, speed);
    case kInterfaceRecipient:
      return of_interface(setup);
    case kEndpointRecipient:
      return of_endpoint(setup);
    default:
      return {};
  }
}

Response Control::of_device(const Setup& setup, Speed speed) {
  if (setup.to_host()) {
    if (setup.request == request::kGetStatus) return send_small(setup, kSelfPowered, 2);
    if (setup.request == request::kGetDescriptor) return descriptor(setup, speed);
    if (setup.request == request::kGetConfiguration) return send_small(setup, configuration_, 1);
    return {};
  }
  if (setup.request == request::kSetAddress && setup.value < 128) {
    address_ = static_cast<std::uint8_t>(setup.value);
    changes_.address = true;
    return acknowledge();
  }
  if (setup.request == request::kSetConfiguration && setup.value <= 1) {
    configuration_ = static_cast<std::uint8_t>(setup.value);
    halted_ = 0;
    line_state_ = 0;
    changes_.endpoints = true;
    return acknowledge();
  }
  return {};
}

Response Control::of_interface(const Setup& setup) {
  if (!configured() || setup.index >= kInterfaces) return {};
  if (setup.request == request::kGetStatus && setup.to_host()) return send_small(setup, 0, 2);
  if (setup.request == request::kGetInterface && setup.to_host()) return send_small(setup, 0, 1);
  if (setup.request == request::kSetInterface && !setup.to_host() && setup.value == 0) {
    halted_ = 0;
    changes_.endpoints = true;  // toggles, too (USB 2.0, 9.1.1.5)
    return acknowledge();
  }
  return {};
}

Response Control::of_endpoint(const Setup& setup) {
  const auto endpoint = static_cast<std::uint8_t>(setup.index);
  const bool control = (endpoint & 0x7F) == 0;
  if (!control && (!configured() || !exists(endpoint))) return {};
  if (setup.request == request::kGetStatus && setup.to_host())
    return send_small(setup, !control && halted(endpoint) ? 1 : 0, 2);
  if (setup.value != kHalt || setup.to_host()) return {};
  if (setup.request == request::kClearFeature) {
    if (control) return acknowledge();
    halted_ = static_cast<std::uint8_t>(halted_ & ~bit(endpoint));
    changes_.unhalted = endpoint;
    return acknowledge();
  }
  if (setup.request == request::kSetFeature && !control) {
    halted_ = static_cast<std::uint8_t>(halted_ | bit(endpoint));
    changes_.halted = endpoint;
    return acknowledge();
  }
  return {};
}

Response Control::of_class(const Setup& setup) {
  if ((setup.type & kRecipientMask) != kInterfaceRecipient || setup.index != 0 || !configured()) return {};
  if (setup.request == request::kSetLineCoding && !setup.to_host() && setup.length == kLineCodingBytes)
    return {.kind = Response::Kind::receive, .length = kLineCodingBytes};
  if (setup.request == request::kGetLineCoding && setup.to_host()) {
    store_little_endian(&reply_[0], coding_.baud);
    reply_[4] = coding_.stop_bits;
    reply_[5] = coding_.parity;
    reply_[6] = coding_.data_bits;
    return send(std::span(reply_).first(kLineCodingBytes), setup);
  }
  if (setup.request == request::kSetControlLineState && !setup.to_host()) {
    const bool listened = listening();
    line_state_ = setup.value;
    changes_.closed = listened && !listening();
    return acknowledge();
  }
  if (setup.request == request::kSendBreak && !setup.to_host()) return acknowledge();
  return {};
}

void Control::on_data(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kLineCodingBytes) return;
  coding_.baud = load_little_endian<std::uint32_t>(&bytes[0]);
  coding_.stop_bits = bytes[4];
  coding_.parity = bytes[5];
  coding_.data_bits = bytes[6];
}

Response Control::descriptor(const Setup& setup, Speed speed) {
  const std::uint8_t number = low(setup.value);
  const Speed other = speed == Speed::high ? Speed::full : Speed::high;
  const auto configure = [&](Speed of, DescriptorType type) {
    reply_ = configuration(of, type);
    return send(reply_, setup);
  };
  const auto text = [&](std::string_view words) {
    const StringDescriptor string(words);
    std::copy_n(string.bytes.begin(), string.size, reply_.begin());
    return send(std::span(reply_).first(string.size), setup);
  };
  switch (static_cast<DescriptorType>(high(setup.value))) {
    case DescriptorType::device:
      return send(device(identity_), setup);
    case DescriptorType::qualifier:
      return identity_.fastest == Speed::high ? send(kQualifier, setup) : Response{};
    case DescriptorType::configuration:
      return number == 0 ? configure(speed, DescriptorType::configuration) : Response{};
    case DescriptorType::other_speed:
      return number == 0 && identity_.fastest == Speed::high ? configure(other, DescriptorType::other_speed)
                                                             : Response{};
    case DescriptorType::string:
      if (number == 0) return send(kLanguages, setup);
      if (number == 1) return text(kManufacturer);
      if (number == 2) return text(kProduct);
      if (number == 3) return text(serial_number_);
      return {};
    default:
      return {};
  }
}

}  // namespace astro::usb_device
