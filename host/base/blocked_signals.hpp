#pragma once

#include <signal.h>

namespace astro {

/// Blocks all signals in the calling thread during its lifetime. A thread that is started meanwhile never gets any, so
/// they go to the program's own thread: a signal elsewhere would not interrupt what that thread waits for.
class BlockedSignals {
 public:
  BlockedSignals() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;
  ~BlockedSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

}  // namespace astro
