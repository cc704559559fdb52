#pragma once

#include "common/protocol/telemetry.hpp"
#include "firmware/app/tick/drive.hpp"

namespace astro {

/// All telemetry groups as of the last tick. Only copies, because it is called while the tick is held.
protocol::Telemetry snapshot(const Drive& drive, std::uint64_t time_us, std::int32_t battery_mv);

}  // namespace astro
