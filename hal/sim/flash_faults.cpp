#include "hal/sim/flash_faults.hpp"

#include <algorithm>

#include "hal/sim/noise.hpp"

namespace astro::sim {

void FlashFaults::cut_power_after(std::uint64_t bytes, Tear tear, std::uint64_t seed) {
  cut_at_ = worked_ + bytes;
  tear_ = tear;
  mixture_ = hash(seed, 0, bytes);
}

void FlashFaults::restore_power() {
  powered_ = true;
  cut_at_ = kNever;
}

std::uint8_t FlashFaults::held(std::uint32_t at, std::uint8_t wanted) const {
  for (const Stuck& stuck : stuck_) {
    if (stuck.at != at) continue;
    wanted = static_cast<std::uint8_t>(stuck.level ? wanted | stuck.mask : wanted & ~stuck.mask);
  }
  return wanted;
}

bool FlashFaults::takes(FlashWork kind, std::uint32_t at) const {
  return std::none_of(failing_.begin(), failing_.end(), [&](const Failing& range) {
    return range.kind == kind && at - range.begin < range.bytes;
  });
}

std::uint8_t FlashFaults::torn(std::uint32_t at, std::uint8_t old, std::uint8_t target) const {
  const std::uint64_t mask = scramble(mixture_ + at);
  return static_cast<std::uint8_t>((old & mask) | (target & ~mask));
}

// After the cut the call continues only to tear the bytes that were still to be done.
template <class Target>
void FlashFaults::work(FlashWork kind, std::uint32_t at, std::span<std::uint8_t> cells, Target target) {
  if (!powered_) return;
  const bool healthy = stuck_.empty() && failing_.empty();
  const auto whole = static_cast<std::uint32_t>(std::min<std::uint64_t>(cells.size(), cut_at_ - worked_));
  const auto put = [&](std::uint32_t i, std::uint8_t wanted) {
    if (healthy || takes(kind, at + i)) cells[i] = healthy ? wanted : held(at + i, wanted);
  };
  for (std::uint32_t i = 0; i < whole; ++i) put(i, target(i));
  worked_ += whole;
  if (worked_ < cut_at_) return;
  powered_ = false;
  const auto under_way = static_cast<std::uint32_t>(cells.size()) - whole;
  const std::uint32_t tears = tear_ == Tear::sharp ? 0 : tear_ == Tear::byte ? 1 : under_way;
  for (std::uint32_t i = whole; i < whole + std::min(tears, under_way); ++i)
    put(i, torn(at + i, cells[i], target(i)));
}

void FlashFaults::erase(std::uint32_t at, std::span<std::uint8_t> cells) {
  work(FlashWork::erase, at, cells, [](std::uint32_t) { return std::uint8_t{0xFF}; });
}

void FlashFaults::program(std::uint32_t at, std::span<std::uint8_t> cells,
                          std::span<const std::uint8_t> bytes) {
  work(FlashWork::program, at, cells,
       [&](std::uint32_t i) { return static_cast<std::uint8_t>(cells[i] & bytes[i]); });
}

}  // namespace astro::sim
