#pragma once

#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// The travel of wheels of which a recording has the speeds, per second: trapezoids from sample to sample,
/// from 0 on. Times increase strictly. A remark says that they were integrated, and what error the sampling
/// may leave: a third of the difference to trapezoids over two samples each, as for any smooth motion. `what`
/// names the speeds: "the joints' velocities".
std::vector<WheelSample> integral_of(const std::vector<WheelSample>& speeds, const std::string& what,
                                     std::vector<Remark>& remarks);

}  // namespace astro::importing
