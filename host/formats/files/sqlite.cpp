#include "host/formats/files/sqlite.hpp"

namespace astro::bag {

std::string sqlite_uri(const std::filesystem::path& path, std::string_view options) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.~/";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const char c : path.string()) {
    if (kPlain.find(c) != std::string_view::npos) {
      uri += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      uri += {'%', kHex[byte / 16], kHex[byte % 16]};
    }
  }
  return uri.append("?").append(options);
}

}  // namespace astro::bag
