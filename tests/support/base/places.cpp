#include "tests/support/base/places.hpp"

namespace astro::support {

// Here alone, and not in the command line of every test, which a compiler cache would then know in this checkout only.
std::filesystem::path checkout() { return ASTRO_CHECKOUT; }
std::filesystem::path shared_data() { return checkout() / "../shared/data"; }

}  // namespace astro::support
