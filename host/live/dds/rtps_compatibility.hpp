#pragma once

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/live/dds/participant.hpp"

/// Changes what CycloneDDS sends and Fast DDS 2.9 does not understand. Precondition of all functions: the datagram is sound
/// (`rtps_check.hpp`).
namespace astro::dds {

struct Acknowledgement {
  Guid reader, writer;

  auto operator<=>(const Acknowledgement&) const = default;
};

/// Numbers the acknowledgements of each reader to each writer in the order in which they come. It remembers at most
/// kMostPairs pairs. Any thread may call it.
class AcknowledgementCounts {
 public:
  static constexpr std::size_t kMostPairs = 10'000;

  /// The next number for this pair, which is greater than all its earlier ones.
  std::uint32_t next(const Acknowledgement& pair) {
    const std::lock_guard lock(mutex_);
    if (given_.size() >= kMostPairs && !given_.contains(pair))
      given_.clear();  // and all go on above the highest
    std::uint32_t& count = given_.try_emplace(pair, highest_).first->second;
    highest_ = std::max(highest_, ++count);
    return count;
  }

 private:
  std::mutex mutex_;
  std::map<Acknowledgement, std::uint32_t> given_;
  std::uint32_t highest_ = 0;
};

/// The datagram, changed so that Fast DDS understands it, and as long as before; nothing if no change is needed.
///
/// - A reader that has found a writer sends an empty acknowledgement, so that the writer begins with a heartbeat. In
///   CycloneDDS its set begins at 1 and its count is 0, also if the reader has lost the writer and found it again. Fast DDS
///   accepts only a set that begins at 0, and a count that is greater than the last one. So the set is changed to begin at 0,
///   and the count of every acknowledgement is taken from `counts`.
/// - CycloneDDS names an endpoint or participant that has gone by its key alone. Fast DDS accepts no key in a parameter list,
///   and would keep the endpoint until its lease ends. So it gets the same list marked as data.
std::optional<Bytes> for_fast_dds(ByteView datagram, AcknowledgementCounts& counts);

/// The acknowledgements of readers that have had a heartbeat of the writer. Empty first ones, which only say that the reader
/// has found the writer, are left out.
std::vector<Acknowledgement> acknowledgements_in(ByteView datagram);

}  // namespace astro::dds
