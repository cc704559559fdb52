#pragma once

#include <string_view>

#include "host/formats/cdr/message.hpp"

namespace astro::support {

/// A message as a computer with the other byte order writes it, by code that has nothing in common with CdrWriter. For messages
/// of numbers, texts, arrays and sequences.
class BigEndianCdr {
 public:
  template <ros2::Message M>
  static Bytes encode(const M& message) {
    BigEndianCdr out;
    out.put(message);
    return out.bytes_;
  }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (ros2::Message<T>) {
      ros2::for_each_field(value, [&](std::string_view, const auto& field) { put(field); });
    } else if constexpr (Number<T>) {
      while ((bytes_.size() - 4) % sizeof value != 0) bytes_.push_back(0xEE);
      Bytes raw;
      append(raw, value);
      bytes_.insert(bytes_.end(), raw.rbegin(), raw.rend());
    } else if constexpr (std::is_same_v<T, std::string>) {
      put(static_cast<std::uint32_t>(value.size() + 1));
      append(bytes_, as_bytes(value));
      bytes_.push_back(0);
    } else {
      if constexpr (ros2::IsSequence<T>::value) put(static_cast<std::uint32_t>(value.size()));
      for (const auto& each : value) put(each);
    }
  }

  Bytes bytes_{0, 0, 0, 0};
};

}  // namespace astro::support
