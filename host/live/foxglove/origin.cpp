#include "host/live/foxglove/origin.hpp"

#include <algorithm>
#include <array>

namespace astro::foxglove {

bool origin_is_allowed(std::string_view origin, std::span<const std::string> allowed) {
  constexpr std::array<std::string_view, 2> kFoxglove{"https://app.foxglove.dev",
                                                      "https://studio.foxglove.dev"};
  return origin.empty() || std::ranges::find(kFoxglove, origin) != kFoxglove.end() ||
         web::is_this_computer(origin) || std::ranges::find(allowed, origin) != allowed.end();
}

}  // namespace astro::foxglove
