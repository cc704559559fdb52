#pragma once

#include "common/base/nor_flash.hpp"
#include "common/params/commit_mark.hpp"
#include "common/safety/fault_log.hpp"

namespace astro {

/// Who owns which sectors of a board's flash: the fault log the last two, the parameters all others. Their
/// place never changes on a board in the field: firmware finds what the one before it left.
template <NorFlash Flash>
struct FlashLayout {
  static constexpr std::uint32_t kLogSectors = 2, kParameterSectors = Flash::kSectors - kLogSectors;
  static_assert(Flash::kSectors >= 4, "both need two: one is erased while the other holds what counts");

  using Parameters = FlashRegion<Flash, 0, kParameterSectors>;
  using Log = FlashRegion<Flash, kParameterSectors, kLogSectors>;

  /// Beside the entries of the fault log, so that the loss of every parameter sector is noticed.
  using Mark = CommitMark<Log, FaultLog<Log>::kSlotBytes, FaultLog<Log>::kWrittenBytes>;

  explicit FlashLayout(Flash& flash) : parameters(flash), log(flash) {}

  Parameters parameters;
  Log log;
};

}  // namespace astro
