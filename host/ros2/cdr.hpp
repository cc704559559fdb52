#pragma once

#include <string>
#include <string_view>

#include "host/base/bytes.hpp"

/// CDR, the byte format of ROS 2 messages: plain CDR version 1, little-endian, after the 4-byte encapsulation
/// header 00 01 00 00. A number of s bytes starts at a multiple of s, counted from the end of that header; a
/// string is its length including the NUL (u32), the text and the NUL. Structs and fixed arrays add no bytes.
///
/// Source  OMG DDSI-RTPS 2.3, 10.2; DDS-XTypes 1.3, 7.4.1.
namespace astro::ros2 {

inline constexpr std::size_t kCdrHeaderBytes = 4;

class CdrWriter {
 public:
  template <Number T>
  void number(T value) {
    while ((bytes_.size() - kCdrHeaderBytes) % sizeof(T) != 0) bytes_.push_back(0);
    append(bytes_, value);
  }
  void string(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    append(bytes_, as_bytes(text));
    bytes_.push_back(0);
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_{0, 1, 0, 0};
};

/// Reads what CdrWriter or any ROS 2 writer wrote. A message that is too short, has another encapsulation, or
/// has a string that does not end in NUL makes ok() false from then on; numbers read after that are zero.
/// Bytes after the last field are ignored, because writers pad to 4.
class CdrReader {
 public:
  explicit CdrReader(ByteView message) : cursor_(message) {
    const ByteView header = cursor_.take(kCdrHeaderBytes);
    ok_ = cursor_.ok() && header[0] == 0 && header[1] == 1;
  }

  bool ok() const { return ok_ && cursor_.ok(); }

  template <Number T>
  T number() {
    const std::size_t over = (cursor_.offset() - kCdrHeaderBytes) % sizeof(T);
    if (ok() && over != 0) cursor_.take(sizeof(T) - over);
    return ok() ? cursor_.number<T>() : T{};
  }

  /// Accepts the length 0, which some writers use for the empty string.
  std::string string() {
    const auto size = number<std::uint32_t>();
    const ByteView text = cursor_.take(size);
    if (!ok() || text.empty()) return {};
    if (text.back() != 0) ok_ = false;
    return std::string(as_text(text.first(text.size() - 1)));
  }

 private:
  ByteCursor cursor_;
  bool ok_ = false;
};

}  // namespace astro::ros2
