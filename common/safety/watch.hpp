#pragma once

#include <cstdint>

namespace astro {

/// Debounces a condition: advance() returns true once the condition has held `limit` times in a row.
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
