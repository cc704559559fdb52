#include "host/cli/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <cstdlib>

#include "host/link/drive.hpp"

namespace astro::cli {
namespace {

volatile std::sig_atomic_t raised = 0;
std::atomic<void (*)()> last_act = nullptr;
static_assert(decltype(last_act)::is_always_lock_free, "a signal handler reads it");

void on_signal(int) {
  if (raised != 0) {
    if (const auto act = last_act.load()) act();
    std::_Exit(130);
  }
  raised = 1;
}

}  // namespace

void watch_for_interrupt() {
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of the write, and is told as one
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action = {};
    action.sa_handler = on_signal;  // without SA_RESTART: a blocked read returns
    sigaction(signal, &action, nullptr);
  }
}

bool interrupted() { return raised != 0; }

void check_interrupt() {
  if (interrupted()) throw link::Interrupted("interrupted");
}

void before_forced_exit(void (*act)()) { last_act = act; }

}  // namespace astro::cli
