#pragma once

#include "host/base/bytes.hpp"

/// Checks strangers' datagrams before Fast DDS reads them, because it ends the program for some malformed ones.
namespace astro::dds {

/// The largest sample that may come in fragments, since memory is set aside for all of it with the first one.
inline constexpr std::uint32_t kLargestFragmentedSample = 1 << 20;

/// The largest sequence number of a writer, since Fast DDS counts up to the first one that it hears of. A writer of a thousand
/// samples a second gets there after 12 days.
inline constexpr std::int64_t kLargestNumber = 1 << 30;

/// The longest gap of sequence numbers, since memory is taken for each of them. A gap spans at most what its writer keeps.
inline constexpr std::int64_t kLongestGap = 1 << 16;

/// The part of a datagram that Fast DDS may read; empty if it is to be dropped.
///
/// A datagram is dropped unless it has RTPS's header of major version 2 and whole submessages to its last byte, each of them
/// with the fields that the standard gives its kind: sequence numbers and fragments from 1, a first one not behind the last
/// one, sets of 256 numbers at most, gaps that are not too long, inline QoS and a payload inside the submessage, and parameter
/// lists in the payloads of discovery (`rtps_parameters.hpp`). Submessages that the standard leaves undefined are passed on.
///
/// The part ends before the first submessage of a vendor (0x80 and above). Every datagram of Fast DDS ends with such a one, for
/// its statistics; Debian's Fast DDS aborts at one that is not last or has another length.
///
/// Cost    one pass; nothing is copied.
/// Source  DDSI-RTPS 2.2, 8.3.7, 9.4.2 and 9.4.5.
ByteView sound_part(ByteView datagram);

}  // namespace astro::dds
