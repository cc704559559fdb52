#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

/// Little-endian numbers in byte strings. common/base/little_endian.hpp does the same on the robot, for unsigned integers
/// alone; files and links of the host hold signed numbers and floats, too, and host/base uses no other layer.
namespace astro {

static_assert(std::endian::native == std::endian::little, "bytes.hpp copies numbers as they are in memory");

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

template <class T>
concept Number = std::integral<T> || std::floating_point<T>;

/// The number at an offset of bytes that are known to be long enough.
template <Number T>
T load(ByteView bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.subspan(offset, sizeof value).data(), sizeof value);
  return value;
}

/// Writes a number at an offset of bytes that are known to be long enough.
template <Number T>
void store(std::span<std::uint8_t> bytes, std::size_t offset, T value) {
  std::memcpy(bytes.subspan(offset, sizeof value).data(), &value, sizeof value);
}

template <Number T>
void append(Bytes& bytes, T value) {
  const auto* raw = reinterpret_cast<const std::uint8_t*>(&value);
  bytes.insert(bytes.end(), raw, raw + sizeof(T));
}

inline void append(Bytes& bytes, ByteView more) { bytes.insert(bytes.end(), more.begin(), more.end()); }

/// A cursor over untrusted bytes. A read past the end gives zero or nothing and makes ok() false from then
/// on, so that a caller checks once, after the last field.
class ByteCursor {
 public:
  explicit ByteCursor(ByteView bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  std::size_t offset() const { return offset_; }
  std::size_t left() const { return bytes_.size() - offset_; }

  ByteView take(std::uint64_t size) {
    if (!ok_ || size > left()) {
      ok_ = false;
      return {};
    }
    const ByteView taken = bytes_.subspan(offset_, static_cast<std::size_t>(size));
    offset_ += taken.size();
    return taken;
  }

  template <Number T>
  T number() {
    const ByteView raw = take(sizeof(T));
    return ok_ ? load<T>(raw, 0) : T{};
  }

 private:
  ByteView bytes_;
  std::size_t offset_ = 0;
  bool ok_ = true;
};

inline ByteView as_bytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}
inline std::string_view as_text(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace astro
