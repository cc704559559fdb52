#pragma once

#include "hal/rp2040/registers/access.hpp"

/// The registers of the RP2040 that this project uses, by their names in the data sheet: an instance, a register of its
/// type, a field of the register.
///
///   TIMER[timer::ALARM0].write(due);
///   RESETS[resets::RESET].clear(resets::RESET_PWM.mask());
///
/// One `.def` file a type holds them.
#define INSTANCE(type, name, address) inline constexpr Peripheral<type::Type> name{address};
#define REGISTER(type, name, offset)          \
  namespace type {                            \
  inline constexpr Offset<Type> name{offset}; \
  }
#define FIELD(type, reg, name, lsb, width)        \
  namespace type {                                \
  inline constexpr Bits reg##_##name{lsb, width}; \
  }
#define TYPE(type) \
  namespace type { \
  struct Type;     \
  }

namespace astro::rp2040 {

#include "hal/rp2040/registers/all.def"

}  // namespace astro::rp2040

#undef TYPE
#undef INSTANCE
#undef REGISTER
#undef FIELD
