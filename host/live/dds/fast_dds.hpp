#pragma once

#include <memory>
#include <string>

#include "host/live/dds/discovery.hpp"
#include "host/live/dds/participant.hpp"

namespace astro::dds {

/// A participant on eProsima Fast DDS, the default of ROS 2. `user_data` is shown to all others ("enclave=/;").
///
/// A topic that is asked for under a second type is carried by a participant beside this one, because Fast DDS knows one type
/// for each topic of a participant.
///
/// Throws astro::Error if the network does not allow it.
std::unique_ptr<Participant> open_fast_dds(const Discovery& discovery, const std::string& name,
                                           const std::string& user_data);

}  // namespace astro::dds
