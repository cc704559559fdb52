#include "host/console/interrupt.hpp"

#include <time.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>

#include "host/base/interrupted.hpp"

namespace astro::console {
namespace {

volatile std::sig_atomic_t raised = 0;
std::atomic<void (*)()> last_act = nullptr;
static_assert(decltype(last_act)::is_always_lock_free, "a signal handler reads it");

/// Programs that end others send a signal to the process and then to its group, and a terminal that closes
/// sends several signals in a row. Only a second Ctrl-C of a person means: end at once, wait for nothing.
constexpr std::int64_t kAgain_ms = 300;
std::atomic<std::int64_t> raised_at_ms = 0;

std::int64_t now_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
}

void on_signal(int signal) {
  if (raised == 0) {
    raised_at_ms = now_ms();
    raised = 1;
    return;
  }
  if (signal != SIGINT || now_ms() - raised_at_ms < kAgain_ms) return;
  if (const auto act = last_act.load()) act();
  std::_Exit(130);
}

}  // namespace

void watch_for_interrupt() {
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow then is an error of write(), and is reported as one
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action = {};
    action.sa_handler = on_signal;  // without SA_RESTART: a blocked read returns
    sigaction(signal, &action, nullptr);
  }
}

bool interrupted() { return raised != 0; }

void check_interrupt() {
  if (interrupted()) throw Interrupted("interrupted");
}

void before_forced_exit(void (*act)()) { last_act = act; }

}  // namespace astro::console
