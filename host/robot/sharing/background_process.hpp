#pragma once

#include <span>

namespace astro::robot {

/// Leaves a process behind that goes on with what this one was doing. Forks twice, so that no process has to wait for
/// the one that stays. Call it while this process has one thread.
///
/// Returns true in the process that stays: in a session of its own, with the default signal handlers, and with no open
/// descriptors but `keep` and empty standard streams. Returns false in this process, also if it could not be done.
bool leave_process_behind(const char* name, std::span<const int> keep);

}  // namespace astro::robot
