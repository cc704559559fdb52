#pragma once

#include <optional>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/ros2/dds/participant.hpp"

/// What CycloneDDS sends and Fast DDS 2.9 does not understand. All of this takes datagrams that are sound (`rtps_check.hpp`).
namespace astro::ros2::dds {

/// The datagram as Fast DDS understands it, in as many bytes; nothing if it does so anyway.
///
/// - A reader that has found a writer says so with an acknowledgement of nothing, so that the writer begins with a heartbeat.
///   CycloneDDS gives it the set from 1 and the count 0, where Fast DDS knows the set from 0 and takes no count of 0 at all. It
///   gets the set from 0, and all acknowledgements counts that are greater by one.
/// - An endpoint or participant that has gone is named by its key alone. Fast DDS takes none in a parameter list, and would keep
///   it until the lease ends. It gets the same list as data.
std::optional<Bytes> for_fast_dds(ByteView datagram);

struct Acknowledgement {
  Guid reader, writer;

  auto operator<=>(const Acknowledgement&) const = default;
};

/// The acknowledgements of readers that have had a heartbeat of the writer. One that says that its reader has found the writer
/// is none of them.
std::vector<Acknowledgement> acknowledgements_in(ByteView datagram);

}  // namespace astro::ros2::dds
