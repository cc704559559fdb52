#pragma once

#include <cstdint>

namespace astro {

/// True once a condition has held for `limit` ticks in a row.
class Watch {
 public:
  bool advance(bool condition, std::uint32_t limit) {
    ticks_ = condition ? ticks_ + 1 : 0;
    return ticks_ >= limit;
  }
  void reset() { ticks_ = 0; }

 private:
  std::uint32_t ticks_ = 0;
};

}  // namespace astro
