#include "hal/rp2040/core/library.hpp"

#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/registers/registers.hpp"

namespace astro::rp2040 {
namespace {

struct Quotient {
  std::uint32_t whole, rest;
};

inline Quotient divide(std::uint32_t dividend, std::uint32_t divisor) {
  const cpu::InterruptsOff guard;
  SIO[sio::DIV_UDIVIDEND].write(dividend);
  SIO[sio::DIV_UDIVISOR].write(divisor);
  while (SIO[sio::DIV_CSR].get(sio::DIV_CSR_READY) == 0) {
  }
  const std::uint32_t rest = SIO[sio::DIV_REMAINDER].read();
  return {SIO[sio::DIV_QUOTIENT].read(), rest};
}

/// As common/fixed/narrow_multiply.hpp, without signs.
inline std::uint64_t multiply(std::uint64_t a, std::uint64_t b) {
  const auto a_word = static_cast<std::uint32_t>(a), b_word = static_cast<std::uint32_t>(b);
  const auto a_upper = static_cast<std::uint32_t>(a >> 32), b_upper = static_cast<std::uint32_t>(b >> 32);
  const std::uint32_t a_low = a_word & 0xFFFF, b_low = b_word & 0xFFFF, a_high = a_word >> 16,
                      b_high = b_word >> 16;
  const std::uint32_t middle = a_high * b_low + (a_low * b_low >> 16);
  const std::uint32_t other = a_low * b_high + (middle & 0xFFFF);
  const std::uint32_t high =
      a_high * b_high + (middle >> 16) + (other >> 16) + a_upper * b_word + a_word * b_upper;
  return std::uint64_t{high} << 32 | a_word * b_word;
}

}  // namespace
}  // namespace astro::rp2040

extern "C" {

std::uint64_t __aeabi_lmul(std::uint64_t a, std::uint64_t b) { return astro::rp2040::multiply(a, b); }
std::uint64_t __muldi3(std::uint64_t a, std::uint64_t b) { return astro::rp2040::multiply(a, b); }

std::uint32_t __aeabi_uidiv(std::uint32_t dividend, std::uint32_t divisor) {
  return astro::rp2040::divide(dividend, divisor).whole;
}
std::uint32_t __udivsi3(std::uint32_t dividend, std::uint32_t divisor) {
  return astro::rp2040::divide(dividend, divisor).whole;
}
std::uint64_t __aeabi_uidivmod(std::uint32_t dividend, std::uint32_t divisor) {
  const auto [whole, rest] = astro::rp2040::divide(dividend, divisor);
  return std::uint64_t{rest} << 32 | whole;
}

// The compiler must not turn the loops into a call of this very function.
[[gnu::optimize("no-tree-loop-distribute-patterns")]] void* memcpy(void* to, const void* from,
                                                                   std::size_t size) {
  auto* byte = static_cast<std::uint8_t*>(to);
  const auto* source = static_cast<const std::uint8_t*>(from);
  using Word [[gnu::may_alias]] = std::uint32_t;
  if (((reinterpret_cast<std::uintptr_t>(to) | reinterpret_cast<std::uintptr_t>(from)) & 3) == 0)
    for (; size >= 4; size -= 4, byte += 4, source += 4)
      *reinterpret_cast<Word*>(byte) = *reinterpret_cast<const Word*>(source);
  for (; size != 0; --size) *byte++ = *source++;
  return to;
}
}
