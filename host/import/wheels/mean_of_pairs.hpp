#pragma once

#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// The left and the right wheel of one axle.
using Wheels = std::vector<WheelSample>;

/// The wheels of several axles as those of one: the mean of each side, sample by sample. A remark for each side says by how
/// many percent of the longest way its wheels differ; `left` and `right` are their names. The same, without a remark, for one
/// axle. All axles have the same samples; only the first may be missing in some (restarts.hpp), and is then left out in all.
Wheels mean_of_pairs(std::vector<Wheels> pairs, const std::vector<std::string>& left,
                     const std::vector<std::string>& right, std::vector<Remark>& remarks);

}  // namespace astro::importing
