#pragma once

#include "common/base/nor_flash.hpp"
#include "common/params/commit_mark.hpp"
#include "common/safety/fault_log.hpp"

namespace astro {

/// Who owns which sectors of a board's flash: the fault log owns the last two, the parameters all others.
/// This never changes, so that new firmware finds what older firmware has left.
template <NorFlash Flash>
struct FlashLayout {
  static constexpr std::uint32_t kLogSectors = 2, kParameterSectors = Flash::kSectors - kLogSectors;
  static_assert(Flash::kSectors >= 4, "each needs two: one is erased while the other keeps the data");

  using Parameters = FlashRegion<Flash, 0, kParameterSectors>;
  using Log = FlashRegion<Flash, kParameterSectors, kLogSectors>;

  /// In the fault log's sectors, so that the loss of all parameter sectors is noticed.
  using Mark = CommitMark<Log, FaultLog<Log>::kSlotBytes, FaultLog<Log>::kWrittenBytes>;

  explicit FlashLayout(Flash& flash) : parameters(flash), log(flash) {}

  Parameters parameters;
  Log log;
};

}  // namespace astro
