#include "host/live/foxglove/origin.hpp"

#include <algorithm>
#include <array>

namespace astro::foxglove {
namespace {

constexpr std::array<std::string_view, 2> kFoxglove{"https://app.foxglove.dev",
                                                    "https://studio.foxglove.dev"};
constexpr std::array<std::string_view, 2> kSchemes{"http://", "https://"};
constexpr std::array<std::string_view, 3> kThisComputer{"localhost", "127.0.0.1", "[::1]"};

bool is_port(std::string_view text) {
  return text.empty() || (text.size() > 1 && text.size() <= 6 && text[0] == ':' &&
                          text.find_first_not_of("0123456789", 1) == std::string_view::npos);
}

bool is_this_computer(std::string_view origin) {
  for (const std::string_view scheme : kSchemes)
    for (const std::string_view host : kThisComputer) {
      if (!origin.starts_with(scheme) || !origin.substr(scheme.size()).starts_with(host)) continue;
      if (is_port(origin.substr(scheme.size() + host.size()))) return true;
    }
  return false;
}

}  // namespace

bool origin_is_allowed(std::string_view origin, std::span<const std::string> allowed) {
  return origin.empty() || std::find(kFoxglove.begin(), kFoxglove.end(), origin) != kFoxglove.end() ||
         is_this_computer(origin) || std::find(allowed.begin(), allowed.end(), origin) != allowed.end();
}

bool is_origin(std::string_view origin) {
  const std::size_t colon = origin.find("://");
  if (colon == std::string_view::npos) return origin == "null";
  if (origin == "file://") return true;
  const std::string_view host = origin.substr(colon + 3);
  return colon > 0 && !host.empty() && host.find_first_of("/?# \t") == std::string_view::npos;
}

bool origin_can_be_proposed(std::string_view origin) {
  constexpr std::size_t kLongest = 100;
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.:/_[]-";
  return origin.size() <= kLongest && origin.find("://") != std::string_view::npos &&
         origin.find_first_not_of(kPlain) == std::string_view::npos;
}

}  // namespace astro::foxglove
