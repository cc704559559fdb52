#pragma once

#include <string_view>

/// Whether poses come from a tracker or from the robot itself, as far as the name and the type of their topic say.
namespace astro::ros2 {

/// Tracking systems by name, "tracker", and what simulators call the true pose.
bool speaks_of_tracker(std::string_view topic);

/// The topics of odometry, of filters and of localisation, and the types that they publish, unless the name says the
/// contrary. A "tracker" may as well be a controller that tracks a path, so that word says nothing here.
bool may_be_estimate(std::string_view topic, std::string_view type);

}  // namespace astro::ros2
