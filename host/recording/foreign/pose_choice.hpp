#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/base/remedy.hpp"
#include "host/recording/foreign/pose_topics.hpp"

/// Which of the streams of poses in a bag is ground truth.
namespace astro::recording {

/// Whether a robot or a filter publishes such poses of itself: odometry, transforms and poses with a covariance by their
/// type, others by their topic's name. A topic whose name speaks of ground truth or of a tracking system holds none.
bool is_estimate(const PoseStream& stream);

/// The only stream that is selected. If several are, the only one whose topic's name speaks of ground truth, or else the
/// only one that is no estimate. An estimate is chosen only if the selection names it, because wheels that are
/// calibrated against their own odometry seem perfect. A remark says what was inferred, and that an estimate was named.
///
/// Errors  UnclearChoice with the names of the streams if none or several are left; `path` is for its text.
const PoseStream& chosen_stream(const std::filesystem::path& path, std::span<const PoseStream> streams,
                                const PoseSelection& selection, std::vector<Remark>& remarks);

}  // namespace astro::recording
