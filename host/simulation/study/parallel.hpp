#pragma once

#include <functional>

namespace astro::simulation::study {

/// Calls work(0) ... work(count - 1), each once, on `jobs` threads; returns when all are done.
///
/// `meanwhile(done)` is called by the caller's own thread, about ten times a second and once at the end. If
/// it or `work` throws, running calls are finished, no others begin, and the first exception is rethrown
/// here.
void in_parallel(
    int count, int jobs, const std::function<void(int)>& work,
    const std::function<void(int done)>& meanwhile = [](int) {});

}  // namespace astro::simulation::study
