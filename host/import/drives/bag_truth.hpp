#pragma once

#include <filesystem>

#include "host/import/bags/pose_topics.hpp"
#include "host/truth/files/body_track.hpp"

namespace astro::importing {

/// Reads the selected stream of poses in a bag as a track. The body is named after the child frame, or after
/// the topic if the messages have no child frame. An impossible pose, such as one of zeros or NaN, counts as
/// lost by the tracker. If no pose has a rotation, the messages are taken as positions only, as in our own
/// export of a tracked point. Errors as poses_in_bag.
truth::BodyTrack track_in_bag(const std::filesystem::path& path, const PoseSelection& selection = {});

}  // namespace astro::importing
