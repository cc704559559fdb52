#pragma once

#include <unistd.h>

namespace astro::support {

/// Of DDS: one for each test program and the next one besides, so that programs that run side by side do not meet. Domains
/// above 101 would use ports that Linux gives to others.
inline int test_domain() { return 1 + 2 * static_cast<int>(getpid() % 50); }

}  // namespace astro::support
