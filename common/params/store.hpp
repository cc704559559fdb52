#pragma once

#include <cstdint>
#include <optional>

#include "common/base/result.hpp"
#include "common/base/serial_number.hpp"
#include "common/params/parameter_set.hpp"
#include "common/params/record_log.hpp"

namespace astro {

enum class LoadStatus : std::uint8_t {
  loaded,     // the newest set that was committed
  no_record,  // the flash is new or wholly damaged: factory defaults
  refused,    // this firmware's validate() refuses the newest set: factory defaults
};

struct Load {
  ParameterSet set;
  LoadStatus status = LoadStatus::no_record;
  Param refused = Param::none;  // the row that validate() named
  std::uint32_t sequence = 0;   // of the newest record; 0 without one
  std::uint32_t skipped = 0;    // damaged places: rotten bits, interrupted writes and erases
  bool two_sectors = false;     // an older record lies in another sector than the newest ...
  std::uint32_t outside = 0;    // ... and this is the newest there
  bool outrun = false;          // a damaged record claims to be newer than `set` (RecordLog)
};

enum class CommitError : std::uint8_t {
  none,
  refused,       // validate() refuses the set
  no_room,       // rows that newer firmware left in the record fill it
  flash_failed,  // no sector takes the record
};

/// Keeps parameter sets in flash as a log of records that uses the sectors in turn, so that wear is even. The
/// sector of the newest record is never erased: whenever the power fails, the next load() finds either the
/// old set or the new one.
///
/// Flash  at least two sectors of at least one record; used only while the robot is at rest
/// Cost   load and commit read all sectors once; commit programs one record, and erases a sector whenever one
///        is full. RAM: one Record; no heap
template <NorFlash Flash>
class Store {
 public:
  explicit Store(Flash& flash) : log_(flash) {}

  /// Returns the newest intact set, whatever damage lies around it.
  Load load() {
    const auto newest = log_.newest(record_);
    Load load{.set = {},
              .sequence = newest.sequence,
              .skipped = newest.skipped,
              .two_sectors = newest.found_outside,
              .outside = newest.outside,
              .outrun = newest.outrun()};
    if (!newest.found) return load;
    const ParameterSet set = record_.set();
    const auto verdict = validate(set);
    load.status = verdict ? LoadStatus::loaded : LoadStatus::refused;
    if (verdict) {
      load.set = set;
    } else {
      load.refused = verdict.error();
    }
    return load;
  }

  /// Writes `set`, so that load() finds it, and reads it back. Rows that only newer firmware knows stay as
  /// they are. After an error load() finds what it found before. `beyond` is a sequence number that was
  /// already used, perhaps by records that are lost now.
  Result<void, CommitError> commit(const ParameterSet& set, std::optional<std::uint32_t> beyond = {}) {
    if (!validate(set)) return CommitError::refused;
    const auto newest = log_.newest(record_);
    std::uint32_t sequence = next_sequence(newest);
    if (beyond && is_newer(*beyond + 1, sequence)) sequence = *beyond + 1;
    if (!record_.rewrite(set, sequence)) return CommitError::no_room;
    const bool written = newest.found ? write_after(newest.sector()) : write_first();
    if (!written) return CommitError::flash_failed;
    return {};
  }

 private:
  static constexpr std::uint32_t kSectors = RecordLog<Flash>::kSectors;
  static_assert(kSectors >= 2, "one sector is erased while another holds the set");

  /// Larger than any number that a damaged record can claim. A bit that was written halfway may read
  /// correctly one day, and must not make an older set the newest.
  static std::uint32_t next_sequence(const typename RecordLog<Flash>::Newest& newest) {
    return newest.found || newest.skipped != 0 ? newest.sequence + newest.skipped + 1 : 0;
  }

  /// Writes after the newest record, or at the start of the next sector, which is the oldest. If that one is
  /// worn out, tries the others.
  bool write_after(std::uint32_t sector) {
    if (log_.append(sector, record_)) return true;
    for (std::uint32_t step = 1; step < kSectors; ++step) {
      if (log_.restart((sector + step) % kSectors, record_)) return true;
    }
    return false;
  }

  bool write_first() {
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      if (log_.restart(sector, record_)) return true;
    }
    return false;
  }

  RecordLog<Flash> log_;
  Record record_;
};

}  // namespace astro
