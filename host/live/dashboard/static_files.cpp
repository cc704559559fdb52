#include "host/live/dashboard/static_files.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <utility>

namespace astro::dashboard {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kTypes{
    {{".html", "text/html; charset=utf-8"},
     {".js", "text/javascript"},
     {".mjs", "text/javascript"},
     {".css", "text/css"},
     {".wasm", "application/wasm"},
     {".json", "application/json"},
     {".webmanifest", "application/manifest+json"},
     {".svg", "image/svg+xml"},
     {".png", "image/png"},
     {".ico", "image/x-icon"},
     {".woff2", "font/woff2"}}};

std::string type_of(const fs::path& path) {
  const std::string extension = path.extension().string();
  const auto found = std::ranges::find(kTypes, extension, [](const auto& each) { return each.first; });
  return std::string(found == kTypes.end() ? "application/octet-stream" : found->second);
}

/// Neither ".." nor "//", behind which a path would begin at the root of all files.
bool is_plain(std::string_view path) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/";
  return path.starts_with('/') && path.find("..") == path.npos && path.find("//") == path.npos &&
         path.find_first_not_of(kPlain) == path.npos;
}

}  // namespace

web::Fields guarding_fields() {
  return {{"X-Frame-Options", "DENY"},
          {"Content-Security-Policy",
           "frame-ancestors 'none'; base-uri 'none'; form-action 'none'; object-src 'none'"},
          {"Cross-Origin-Opener-Policy", "same-origin"},
          {"Cross-Origin-Embedder-Policy", "require-corp"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Referrer-Policy", "no-referrer"},
          {"X-Content-Type-Options", "nosniff"},
          {"Cache-Control", "no-store"}};
}

web::Response StaticFiles::find(std::string_view path) const {
  const auto none = [] { return web::sentence_response(404, "there is no such file"); };
  if (!is_plain(path)) return none();
  const fs::path file = root_ / (path == "/" ? "index.html" : std::string(path.substr(1)));
  std::error_code gone;
  if (!fs::is_regular_file(file, gone)) return none();
  return {200, {{"Content-Type", type_of(file)}}, {}, file};
}

}  // namespace astro::dashboard
