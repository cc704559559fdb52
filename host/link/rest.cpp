#include "host/link/rest.hpp"

#include <algorithm>

#include "common/params/table.hpp"

namespace astro::link {
namespace {

using std::chrono::milliseconds;

constexpr microseconds kPoll = milliseconds(50);
constexpr microseconds kUsually = milliseconds(5000);

std::int64_t active(Client& client, Param param) {
  return client.request(protocol::GetParameter{static_cast<std::uint16_t>(param)}).active;
}

/// From the fastest legal speed to rest, with a second each for the jerk limit and for the wheels to settle
/// (the robot's own deadline), and one for the link.
microseconds longest_ramp(Client& client) {
  const auto seconds = [&](Param speed, Param acceleration) {
    return static_cast<double>(active(client, speed)) /
           static_cast<double>(std::max<std::int64_t>(active(client, acceleration), 1));
  };
  const double ramp_s = std::max(seconds(Param::speed_limit, Param::acceleration_limit),
                                 seconds(Param::yaw_rate_limit, Param::yaw_acceleration_limit));
  return microseconds(static_cast<std::int64_t>(1e6 * (ramp_s + 3)));
}

bool rests_before(Client& client, microseconds deadline) {
  while (!protocol::at_rest(client.request(protocol::GetStatus{}).mode)) {
    if (client.now() >= deadline) return false;
    client.pump(kPoll);
  }
  return true;
}

}  // namespace

bool wait_for_rest(Client& client) {
  const microseconds start = client.now();
  if (rests_before(client, start + kUsually)) return true;
  if (rests_before(client, start + longest_ramp(client))) return true;
  client.request(protocol::Disarm{});
  return false;
}

}  // namespace astro::link
