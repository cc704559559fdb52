#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "host/truth/trackers/natnet_packet.hpp"

namespace astro::truth::natnet {

/// The names of rigid bodies by their ids, which are all that frames carry.
using BodyNames = std::map<std::int32_t, std::string>;

/// Nothing if the payload does not begin like descriptions of models. Before 4.1 nothing tells the size of a
/// description, so the names end at the first kind that is not known; rigid bodies come before those.
std::optional<BodyNames> body_names_in(ByteView payload, Version version);
Bytes payload_of(const BodyNames& names, Version version);

}  // namespace astro::truth::natnet
