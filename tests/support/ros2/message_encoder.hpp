#pragma once

#include <string_view>

#include "host/formats/cdr/message.hpp"

/// Messages as others write them, by code that has nothing in common with CdrWriter and the readers. For messages of numbers,
/// texts, arrays and sequences.
namespace astro::support {

/// `Wire` says how numbers and texts are written, and what stands before each message.
template <class Wire>
class MessageEncoder {
 public:
  template <ros2::Message M>
  static Bytes encode(const M& message) {
    MessageEncoder out;
    out.put(message);
    return out.bytes_;
  }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (ros2::Message<T>) {
      Wire::begin(bytes_, T::kType);
      ros2::for_each_field(value, [&](std::string_view, const auto& field) { put(field); });
    } else if constexpr (Number<T>) {
      Wire::number(bytes_, value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      Wire::text(bytes_, value);
    } else {
      if constexpr (ros2::IsSequence<T>::value) put(static_cast<std::uint32_t>(value.size()));
      for (const auto& each : value) put(each);
    }
  }

  Bytes bytes_ = Wire::head();
};

/// CDR of a computer with the other byte order.
struct BigEndianWire {
  static Bytes head() { return {0, 0, 0, 0}; }
  static void begin(Bytes&, std::string_view) {}
  static void number(Bytes& bytes, Number auto value) {
    while ((bytes.size() - 4) % sizeof value != 0) bytes.push_back(0xEE);
    Bytes raw;
    append(raw, value);
    bytes.insert(bytes.end(), raw.rbegin(), raw.rend());
  }
  static void text(Bytes& bytes, const std::string& value) {
    number(bytes, static_cast<std::uint32_t>(value.size() + 1));
    append(bytes, as_bytes(value));
    bytes.push_back(0);
  }
};

/// ROS 1: packed, and with a sequence number before each header.
struct Ros1Wire {
  static Bytes head() { return {}; }
  static void begin(Bytes& bytes, std::string_view type) {
    if (type == "std_msgs/msg/Header") number(bytes, std::uint32_t{0xABCDEF01});
  }
  static void number(Bytes& bytes, Number auto value) { append(bytes, value); }
  static void text(Bytes& bytes, const std::string& value) {
    number(bytes, static_cast<std::uint32_t>(value.size()));
    append(bytes, as_bytes(value));
  }
};

using BigEndianCdr = MessageEncoder<BigEndianWire>;
using Ros1Message = MessageEncoder<Ros1Wire>;

}  // namespace astro::support
