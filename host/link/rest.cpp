#include "host/link/rest.hpp"

#include <algorithm>

#include "host/link/parameters.hpp"

namespace astro::link {
namespace {

using std::chrono::milliseconds;

constexpr microseconds kPoll = milliseconds(50);
constexpr microseconds kUsually = milliseconds(5000);

/// From the fastest legal speed to rest, with a second each for the jerk limit and for the wheels to settle
/// (the robot's own deadline), and one for the link. The robot describes its table itself; a limit that it
/// does not have counts for nothing.
microseconds longest_ramp(Client& client) {
  const RemoteParameters parameters = RemoteParameters::fetch(client);
  const auto value = [&](std::string_view name) {
    return parameters.find(name) != nullptr ? std::get<double>(parameters.value(name)) : 0;
  };
  const auto seconds = [&](std::string_view speed, std::string_view acceleration) {
    return value(acceleration) > 0 ? value(speed) / value(acceleration) : 0;
  };
  const double ramp_s = std::max(seconds("speed_limit", "acceleration_limit"),
                                 seconds("yaw_rate_limit", "yaw_acceleration_limit"));
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
