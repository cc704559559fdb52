#pragma once

namespace astro::teensy40::protection {

/// What the processor may touch, execute and keep in its caches; then the caches. A null pointer, a jump into
/// data, a write to code and a stack that has run out of memory end in a fault.
void start();

}  // namespace astro::teensy40::protection
