#pragma once

#include <functional>

namespace astro::simulation::study {

/// Calls work(0) ... work(count - 1), each once, on `jobs` threads; returns when all are done.
///
/// `meanwhile(done)` is called by the caller's own thread, about ten times a second and once at the end. What
/// it or `work` throws ends the rest: calls under way are finished, no others begin, and the first exception
/// comes out here.
void in_parallel(
    int count, int jobs, const std::function<void(int)>& work,
    const std::function<void(int done)>& meanwhile = [](int) {});

}  // namespace astro::simulation::study
