#pragma once

#include "hal/teensy40/registers/access.hpp"

/// The registers of the i.MX RT1062 that this project uses, by their names in the reference manual: an
/// instance, a register of its type, a field of the register.
///
///   PIT[pit::MCR].write(0);
///   ENC1[enc::CTRL].write(enc::CTRL_SWIP(1) | enc::CTRL_REV(1));
///
/// One `.def` file a type holds them, and three readers include those: the drivers, the emulator's models
/// (names for its messages, widths for its checks), and the test that compares every row with independent
/// sources.
#define INSTANCE(type, name, address) inline constexpr Peripheral<type::Type> name{address};
#define REGISTER(type, name, offset, width)                \
  namespace type {                                         \
  inline constexpr Offset<Type, Word<width>> name{offset}; \
  }
#define FIELD(type, reg, name, lsb, width)        \
  namespace type {                                \
  inline constexpr Bits reg##_##name{lsb, width}; \
  }
#define TYPE(type) \
  namespace type { \
  struct Type;     \
  }

namespace astro::teensy40 {

#include "hal/teensy40/registers/all.def"

}  // namespace astro::teensy40

#undef TYPE
#undef INSTANCE
#undef REGISTER
#undef FIELD
