#pragma once

namespace astro::teensy40::protection {

/// Sets up what the processor may access, execute and cache, then switches on the caches. A null pointer, a
/// jump into data, a write to code and a stack overflow end in a fault.
void start();

}  // namespace astro::teensy40::protection
