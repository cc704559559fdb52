#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "host/base/bytes.hpp"

/// CDR, the byte format of ROS 2 messages: plain CDR after an encapsulation header of 4 bytes, which is 00 01 00 00
/// for little-endian version 1. A number of s bytes starts at a multiple of s, counted from the end of that header;
/// a string is its length including the NUL (u32), the text and the NUL; a sequence is its length (u32) and its
/// elements. Structs and fixed arrays add no bytes.
///
/// Source  OMG DDSI-RTPS 2.3, 10.2; DDS-XTypes 1.3, 7.4.1.
namespace astro::ros2 {

inline constexpr std::size_t kCdrHeaderBytes = 4;

/// The longest name of a frame or a joint, in characters; ROS has about the same limit for names of topics. A message may
/// come from anybody, so whoever keeps the names of many messages needs a limit.
inline constexpr std::size_t kLongestName = 255;

/// A recorder writes a thousand messages a second, so the buffer is as long as most messages from the beginning, and
/// what lies behind the written part is zero.
class CdrWriter {
 public:
  CdrWriter() : buffer_(kUsualBytes) { buffer_[1] = 1; }

  template <Number T>
  void number(T value) {
    align(sizeof(T));
    put(&value, sizeof(T));
  }
  /// Numbers of `size` bytes each, a power of two, that are little-endian already.
  void numbers(ByteView raw, std::size_t size) {
    if (raw.empty()) return;
    align(size);
    put(raw.data(), raw.size());
  }
  void string(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size() + 1));
    put(text.data(), text.size());
    reserve(1);
    ++size_;
  }
  std::size_t size() const { return size_; }
  Bytes bytes() const& { return {buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(size_)}; }
  Bytes bytes() && {
    buffer_.resize(size_);
    return std::move(buffer_);
  }

 private:
  static constexpr std::size_t kUsualBytes = 1024;

  void align(std::size_t size) {
    const std::size_t padding = (kCdrHeaderBytes - size_) & (size - 1);
    reserve(padding);
    size_ += padding;
  }
  void reserve(std::size_t more) {
    if (buffer_.size() - size_ < more) buffer_.resize(std::max(2 * buffer_.size(), size_ + more));
  }
  void put(const void* raw, std::size_t count) {
    reserve(count);
    if (count > 0) std::memcpy(buffer_.data() + size_, raw, count);
    size_ += count;
  }

  Bytes buffer_;
  std::size_t size_ = kCdrHeaderBytes;
};

/// Reads what any ROS 2 writer wrote, in either byte order. A message that is too short, has another encapsulation
/// (such as CDR version 2, which ROS 2 does not use), or has a string that does not end in NUL makes ok() false from
/// then on; numbers read after that are zero. Bytes after the last field are ignored, because writers pad to 4.
class CdrReader {
 public:
  explicit CdrReader(ByteView message) : cursor_(message) {
    const ByteView header = cursor_.take(kCdrHeaderBytes);
    ok_ = cursor_.ok() && header[0] == 0 && header[1] <= 1;
    big_endian_ = ok_ && header[1] == 0;
  }

  bool ok() const { return ok_ && cursor_.ok(); }
  /// Makes ok() false, because the caller has seen something that no such message has.
  void refuse() { ok_ = false; }
  std::size_t left() const { return cursor_.left(); }

  template <Number T>
  T number() {
    align(sizeof(T));
    if (!ok()) return T{};
    const ByteView raw = cursor_.take(sizeof(T));
    if (!ok()) return T{};
    std::array<std::uint8_t, sizeof(T)> bytes;
    std::copy(raw.begin(), raw.end(), bytes.begin());
    if (big_endian_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  /// Fills `values`; leaves them as they are if the message is too short.
  template <Number T>
  void numbers(std::span<T> values) {
    if (big_endian_) {
      for (T& value : values) value = number<T>();
      return;
    }
    if (values.empty()) return;
    align(sizeof(T));
    if (const ByteView raw = cursor_.take(values.size_bytes()); ok())
      std::memcpy(values.data(), raw.data(), raw.size());
  }

  /// Skips `count` numbers of one type.
  template <Number T>
  void skip(std::size_t count) {
    if (count == 0) return;
    align(sizeof(T));
    cursor_.take(std::uint64_t{count} * sizeof(T));
  }

  /// The length of a sequence whose elements take at least `least_bytes` each; makes ok() false if so many do not
  /// fit into the rest of the message, so that a caller may reserve memory for them.
  std::size_t length(std::size_t least_bytes) {
    const auto count = number<std::uint32_t>();
    if (count > left() / least_bytes) ok_ = false;
    return ok() ? count : 0;
  }

  /// Valid as long as the message. Accepts the length 0, which some writers use for the empty string.
  std::string_view string() {
    const auto size = number<std::uint32_t>();
    const ByteView text = cursor_.take(size);
    if (!ok() || text.empty()) return {};
    if (text.back() != 0) ok_ = false;
    return as_text(text.first(text.size() - 1));
  }

  /// A string of at most kLongestName characters; a longer one makes ok() false.
  std::string_view name() {
    const std::string_view text = string();
    if (text.size() > kLongestName) ok_ = false;
    return ok() ? text : std::string_view();
  }

 private:
  void align(std::size_t size) {
    if (!ok()) return;
    if (const std::size_t over = (cursor_.offset() - kCdrHeaderBytes) % size; over != 0)
      cursor_.take(size - over);
  }

  ByteCursor cursor_;
  bool ok_ = false;
  bool big_endian_ = false;
};

inline constexpr std::int64_t kNanosPerSecond = 1'000'000'000;

/// builtin_interfaces/Time: seconds (i32) and nanoseconds (u32). Any two numbers make a time: the largest is 2^31 + 4 s.
inline std::int64_t take_time_ns(CdrReader& in) {
  const std::int64_t seconds = in.number<std::int32_t>();
  return seconds * kNanosPerSecond + in.number<std::uint32_t>();
}

}  // namespace astro::ros2
