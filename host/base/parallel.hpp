#pragma once

#include <functional>

namespace astro {

/// Calls work(0) ... work(count - 1), each once, on as many threads as there are processors; returns when all are done. On the
/// caller's own thread alone if there is one processor, or if this is called by a piece of other work that is shared out.
///
/// If `work` throws, running calls are finished, no others begin, and of what was thrown that of the lowest number is rethrown
/// here: it is the same one each time, because numbers are begun in their order.
/// Signals  the threads get none.
void in_parallel(int count, const std::function<void(int)>& work);

/// The same on `jobs` threads, with a look at the progress.
///
/// `meanwhile(done)` is called by the caller's own thread, about ten times a second and once at the end. If it throws, that is
/// rethrown, and no more calls begin.
void in_parallel(int count, int jobs, const std::function<void(int)>& work,
                 const std::function<void(int done)>& meanwhile);

}  // namespace astro
