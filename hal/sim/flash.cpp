#include "hal/sim/flash.hpp"

#include <algorithm>

#include "hal/sim/noise.hpp"

namespace astro::sim {

Flash::Flash(std::span<const std::uint8_t> image) {
  content_.fill(0xFF);
  std::copy_n(image.begin(), std::min<std::size_t>(image.size(), kBytes), content_.begin());
}

// One byte of an erase or program call. The call goes on after the cut only to tear what was still to do.
void Flash::work(std::uint32_t at, std::uint8_t target) {
  if (worked_ < cut_at_) {
    content_[at] = target;
    ++worked_;
  } else if (tear_ == Tear::torn) {
    const auto mask = static_cast<std::uint8_t>(hash(cut_at_, 0, at));
    content_[at] = static_cast<std::uint8_t>((content_[at] & mask) | (target & ~mask));
  }
}

bool Flash::erase(std::uint32_t sector) noexcept {
  if (sector >= kSectors || !powered_) return false;
  const std::uint32_t begin = sector * kSectorBytes;
  for (std::uint32_t at = begin; at < begin + kSectorBytes; ++at) work(at, 0xFF);
  if (worked_ >= cut_at_) powered_ = false;
  return powered_;
}

bool Flash::program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept {
  const bool inside = offset <= kBytes && bytes.size() <= kBytes - offset;
  const bool aligned = offset % kProgramBytes == 0 && bytes.size() % kProgramBytes == 0;
  const bool one_sector = offset % kSectorBytes + bytes.size() <= kSectorBytes;
  if (!inside || !aligned || !one_sector || !powered_) return false;
  bool same = true;
  for (std::uint32_t i = 0; i < bytes.size(); ++i) {
    const auto target = static_cast<std::uint8_t>(content_[offset + i] & bytes[i]);
    work(offset + i, target);
    same = same && content_[offset + i] == bytes[i];
  }
  if (worked_ >= cut_at_) powered_ = false;
  return powered_ && same;
}

void Flash::read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept {
  std::fill(into.begin(), into.end(), std::uint8_t{0xFF});
  if (offset >= kBytes) return;
  std::copy_n(content_.begin() + offset, std::min<std::size_t>(into.size(), kBytes - offset), into.begin());
}

void Flash::cut_power_after(std::uint64_t bytes, Tear tear) {
  cut_at_ = worked_ + bytes;
  tear_ = tear;
}

void Flash::restore_power() {
  powered_ = true;
  cut_at_ = kNever;
}

}  // namespace astro::sim
