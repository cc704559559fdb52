#pragma once

#include "host/base/error.hpp"
#include "host/robot/client/client.hpp"

namespace astro::commands {

/// Sends a request that the robot accepts only while somebody drives it. Throws Error(`otherwise`) if nobody
/// does.
template <protocol::Request M>
void ask_driven(robot::Client& client, const M& request, const char* otherwise) {
  try {
    client.request(request);
  } catch (const robot::RobotRefused& refused) {
    if (refused.code() == protocol::ErrorCode::not_armed) throw Error(otherwise);
    throw;
  }
}

}  // namespace astro::commands
