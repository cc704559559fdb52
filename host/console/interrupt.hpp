#pragma once

namespace astro::console {

/// SIGINT, SIGTERM and SIGHUP set a flag from now on; another SIGINT, 0.3 s later or more, ends the program at
/// once.
void watch_for_interrupt();

/// What whoever drives a robot asks (robot::DriveHooks::interrupted); a drive that is interrupted stops the
/// robot and throws Interrupted, and main exits with 130.
bool interrupted();

/// Throws Interrupted if the flag is set.
void check_interrupt();

/// Called by the SIGINT that ends the program before it does so, and so restricted to what a signal handler may do;
/// nullptr: nothing.
void before_forced_exit(void (*act)());

}  // namespace astro::console
