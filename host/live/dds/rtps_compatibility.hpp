#pragma once

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/live/dds/participant.hpp"

/// What CycloneDDS sends and Fast DDS 2.9 does not understand. All of this takes datagrams that are sound (`rtps_check.hpp`).
namespace astro::dds {

struct Acknowledgement {
  Guid reader, writer;

  auto operator<=>(const Acknowledgement&) const = default;
};

/// Numbers the acknowledgements of each reader to each writer as they come. It remembers so many pairs; any thread may ask.
class AcknowledgementCounts {
 public:
  static constexpr std::size_t kMostPairs = 10'000;

  /// Greater than all that it has given for this pair.
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

/// The datagram as Fast DDS understands it, in as many bytes; nothing if it does so anyway.
///
/// - A reader that has found a writer says so with an acknowledgement of nothing, so that the writer begins with a heartbeat.
///   CycloneDDS gives it the set from 1 and the count 0, also when it has lost the writer and found it again; Fast DDS knows the
///   set from 0 alone, and takes no count that is not greater than the last one. It gets the set from 0, and `counts`.
/// - An endpoint or participant that has gone is named by its key alone. Fast DDS takes none in a parameter list, and would keep
///   it until the lease ends. It gets the same list as data.
std::optional<Bytes> for_fast_dds(ByteView datagram, AcknowledgementCounts& counts);

/// The acknowledgements of readers that have had a heartbeat of the writer. One that says that its reader has found the writer
/// is none of them.
std::vector<Acknowledgement> acknowledgements_in(ByteView datagram);

}  // namespace astro::dds
