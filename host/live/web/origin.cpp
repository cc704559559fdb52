#include "host/live/web/origin.hpp"

#include <array>
#include <boost/asio/ip/address.hpp>
#include <string>

namespace astro::web {
namespace {

constexpr std::array<std::string_view, 2> kSchemes{"http://", "https://"};
constexpr std::array<std::string_view, 3> kThisComputer{"localhost", "127.0.0.1", "[::1]"};

bool is_port(std::string_view text) {
  return text.empty() || (text.size() > 1 && text.size() <= 6 && text[0] == ':' &&
                          text.find_first_not_of("0123456789", 1) == std::string_view::npos);
}

bool is_address(const std::string& text) {
  boost::system::error_code no_address;
  boost::asio::ip::make_address(text, no_address);
  return !no_address;
}

}  // namespace

bool is_this_computer(std::string_view origin) {
  for (const std::string_view scheme : kSchemes)
    for (const std::string_view host : kThisComputer) {
      if (!origin.starts_with(scheme) || !origin.substr(scheme.size()).starts_with(host)) continue;
      if (is_port(origin.substr(scheme.size() + host.size()))) return true;
    }
  return false;
}

bool is_same_origin(std::string_view origin, std::string_view host) {
  return !host.empty() && origin == "http://" + std::string(host);
}

bool host_is_ours(std::string_view host) {
  const std::size_t bracket = host.starts_with('[') ? host.find(']') : 0;
  if (bracket == std::string_view::npos) return false;
  const std::size_t colon = host.find(':', bracket);
  if (colon != std::string_view::npos && !is_port(host.substr(colon))) return false;
  const std::string name(host.substr(0, colon));
  if (name.starts_with('[')) return name.ends_with(']') && is_address(name.substr(1, name.size() - 2));
  return name == "localhost" || is_address(name);
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

}  // namespace astro::web
