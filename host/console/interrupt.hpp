#pragma once

namespace astro::console {

/// From now on SIGINT, SIGTERM and SIGHUP set a flag; a second SIGINT at least 0.3 s later ends the program
/// at once.
void watch_for_interrupt();

/// Whether the flag is set. A drive polls it (robot::DriveHooks::interrupted); an interrupted drive stops the
/// robot and throws Interrupted, and main exits with 130.
bool interrupted();

/// Throws Interrupted if the flag is set.
void check_interrupt();

/// Sets what the SIGINT that ends the program calls before it does so; it may only do what a signal handler
/// may do. nullptr: nothing.
void before_forced_exit(void (*act)());

}  // namespace astro::console
