#pragma once

#include <filesystem>

#include "host/recording/run.hpp"

namespace astro::recording {

/// Writes `odometry.tum` and `truth.tum` into `folder` (created if needed), the format of evo and of the RGB-D benchmark of
/// TUM: seconds, position, quaternion with w last, one pose per line. Times are the robot's clock. Poses that are not valid are
/// left out, and so are those whose heading was not measured, because the format has no gap and any heading would be taken for
/// a measured one; a comment at the end of the file counts them. Each file appears complete or not at all. Throws astro::Error
/// naming the file.
void export_tum(const Run& run, const std::filesystem::path& folder);

}  // namespace astro::recording
