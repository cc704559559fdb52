#pragma once

#include <memory>

#include "host/live/dds/participant.hpp"

namespace astro::support {

/// A participant on Fast DDS with the settings of rmw_fastrtps for ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET, or LOCALHOST. Nothing of it
/// is as host/live/dds sets it: shared memory besides UDP, multicast, and the times that Fast DDS has by itself.
///
/// Source  rmw_fastrtps_shared_cpp: participant.cpp; rmw_fastrtps_cpp: publisher.cpp, subscription.cpp.
std::unique_ptr<dds::Participant> open_stock_participant(int domain, bool subnet);

}  // namespace astro::support
