#pragma once

#include <cstdint>

/// Registers and fields, and how the processor accesses them.
namespace astro::rp2040 {

/// A field: `bits(v)` is v in its place, `mask()` all its ones, `of(word)` its value in a register's word.
struct Bits {
  std::uint32_t lsb, width;

  constexpr std::uint32_t mask() const { return (width == 32 ? ~0U : (1U << width) - 1U) << lsb; }
  constexpr std::uint32_t operator()(std::uint32_t value) const { return value << lsb & mask(); }
  constexpr std::uint32_t of(std::uint32_t word) const { return (word & mask()) >> lsb; }
};

/// A register of 32 bits at its address. Reading and writing are for code on the chip; the address is for everybody.
class Register {
 public:
  constexpr explicit Register(std::uint32_t address) : address_(address) {}

  constexpr std::uint32_t address() const { return address_; }

  std::uint32_t read() const { return *cell(0); }
  void write(std::uint32_t value) const { *cell(0) = value; }
  std::uint32_t get(Bits field) const { return field.of(read()); }

  /// Single stores that change some bits of a peripheral's register, so that no interrupt comes in between. The SIO and
  /// the processor's own registers do not have them.
  void set(std::uint32_t bits) const { *cell(0x2000) = bits; }
  void clear(std::uint32_t bits) const { *cell(0x3000) = bits; }
  /// `field` becomes `value`; all bits change at once.
  void change(Bits field, std::uint32_t value) const {
    *cell(0x1000) = (read() ^ field(value)) & field.mask();
  }

 private:
  volatile std::uint32_t* cell(std::uint32_t alias) const {
    return reinterpret_cast<volatile std::uint32_t*>(
        std::uintptr_t{address_ + alias});  // NOLINT: it is a register
  }

  std::uint32_t address_;
};

/// Where a register lies in its peripheral.
template <class Type>
struct Offset {
  std::uint32_t value;
};

template <class Type>
struct Peripheral {
  std::uint32_t base;

  constexpr Register operator[](Offset<Type> offset) const { return Register(base + offset.value); }
  /// The register of unit `index` where all units have the same registers, `stride` bytes apart.
  constexpr Register at(Offset<Type> offset, std::uint32_t index, std::uint32_t stride) const {
    return Register(base + offset.value + index * stride);
  }
};

}  // namespace astro::rp2040
