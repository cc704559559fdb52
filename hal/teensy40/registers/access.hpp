#pragma once

#include <cstdint>
#include <type_traits>

/// Registers and fields, and how the processor accesses them.
namespace astro::teensy40 {

template <int Width>
using Word = std::conditional_t<Width == 8, std::uint8_t,
                                std::conditional_t<Width == 16, std::uint16_t, std::uint32_t>>;

/// A field: `bits(v)` is v in its place, `mask()` all its ones, `of(word)` its value in a register's word.
struct Bits {
  std::uint32_t lsb, width;

  constexpr std::uint32_t mask() const { return (width == 32 ? ~0U : (1U << width) - 1U) << lsb; }
  constexpr std::uint32_t operator()(std::uint32_t value) const { return value << lsb & mask(); }
  constexpr std::uint32_t of(std::uint32_t word) const { return (word & mask()) >> lsb; }
};

/// A register at its address. Reading and writing are for code on the chip; the address is for everybody.
template <class W>
class Register {
 public:
  constexpr explicit Register(std::uint32_t address) : address_(address) {}

  constexpr std::uint32_t address() const { return address_; }

  W read() const { return *cell(); }
  void write(std::uint32_t value) const { *cell() = static_cast<W>(value); }
  /// Read, clear the bits of `clear`, set those of `set`, write.
  void modify(std::uint32_t clear, std::uint32_t set) const { write((read() & ~clear) | set); }
  std::uint32_t get(Bits field) const { return field.of(read()); }

 private:
  volatile W* cell() const {
    return reinterpret_cast<volatile W*>(static_cast<std::uintptr_t>(address_));  // NOLINT: it is a register
  }

  std::uint32_t address_;
};

/// Where a register lies in its peripheral.
template <class Type, class W>
struct Offset {
  std::uint32_t value;
};

template <class Type>
struct Peripheral {
  std::uint32_t base;

  template <class W>
  constexpr Register<W> operator[](Offset<Type, W> offset) const {
    return Register<W>(base + offset.value);
  }
};

}  // namespace astro::teensy40
