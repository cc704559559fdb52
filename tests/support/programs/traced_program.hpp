#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// Programs that are disturbed at a system call: deterministic where a signal after so many milliseconds is
/// not, and exhaustive, because between two system calls that change something a killed program leaves the
/// same behind.
namespace astro::support {

enum class Harm {
  none,
  fails,          // the call is not made and returns an error that it may return
  killed_before,  // SIGKILL instead of the call
  killed_amid,    // SIGKILL after half of what the call was to write; as killed_before if it writes nothing
};

struct Interference {
  Harm harm = Harm::none;
  std::size_t at = 0;  // which call, counted from 1
};

struct TracedOutcome {
  int code = 0;  // exit code, or 128 + the signal that ended it
  std::string out, err;
  std::vector<std::string> calls;  // those that count, in their order: "write 17 bytes to /tmp/x"
  bool was_hit = false;            // the interference took place
};

/// False where the system does not let a program trace its child.
bool can_trace();

/// Runs a program to its end, with stdin from /dev/null and at most 100 s of time. Calls count that change
/// something outside of the program, that is to create, open for writing, write, rename, remove or
/// synchronise files, to open and write to terminals, and to open files below `folder` for reading. Messages
/// to stderr do not count.
///
/// `hooks.counts` narrows that down further, by the text that TracedOutcome::calls would have;
/// `hooks.started` is given the program's process id, for instance to end one that would run for ever.
struct TraceHooks {
  std::function<bool(const std::string& call)> counts = [](const std::string&) { return true; };
  std::function<void(int pid)> started = [](int) {};
};
TracedOutcome run_traced(const std::vector<std::string>& command, const std::string& folder,
                         Interference interference, const TraceHooks& hooks = {});

}  // namespace astro::support
