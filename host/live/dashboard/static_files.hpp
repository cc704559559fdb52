#pragma once

#include <filesystem>
#include <string_view>

#include "host/live/web/site.hpp"

namespace astro::dashboard {

/// Fields of every response: no other page may frame it, embed it or read it, and the page is isolated, as shared memory needs.
web::Fields guarding_fields();

/// The page's own files. Nothing in them is secret.
class StaticFiles {
 public:
  explicit StaticFiles(std::filesystem::path root) : root_(std::move(root)) {}

  /// `path`: of the request, "/" for index.html. 404 for what is not there, and for any name that is not one of plain letters.
  web::Response find(std::string_view path) const;

 private:
  std::filesystem::path root_;
};

}  // namespace astro::dashboard
