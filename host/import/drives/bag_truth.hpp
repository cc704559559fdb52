#pragma once

#include <filesystem>

#include "host/import/wheels/pose_topics.hpp"
#include "host/truth/files/body_track.hpp"

namespace astro::importing {

/// The selected stream of poses in a bag as a track. Its body is named like the child frame, or like the topic if the
/// messages have none. A pose that no body can have, such as one of zeros or NaN, is one that the tracker had lost;
/// but if no pose has a rotation, the messages are positions only, as our own export of a point that was tracked.
/// Errors as recording::poses_in_bag.
truth::BodyTrack track_in_bag(const std::filesystem::path& path, const PoseSelection& selection = {});

}  // namespace astro::importing
