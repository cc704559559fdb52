#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <memory>
#include <string>

#include "host/ros2/dds/discovery.hpp"
#include "host/ros2/dds/fast_transport.hpp"
#include "host/ros2/dds/fast_types.hpp"

namespace astro::ros2::dds {

/// How a participant of this name looks for others, and where it can be reached. It sends nothing before the gate opens.
/// Throws astro::Error naming a static peer that has no address.
fast::DomainParticipantQos participant_settings(const Discovery& discovery, const std::string& name,
                                                std::shared_ptr<const Gate> gate,
                                                std::shared_ptr<AcknowledgedBy> acknowledged);

}  // namespace astro::ros2::dds
