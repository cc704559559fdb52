#include "host/base/system_error.hpp"

#include <sys/resource.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace astro {

std::string system_reason(int code) {
  if (code == ENFILE) return "all programs together have as many files open as this computer allows";
  if (code != EMFILE) return std::generic_category().message(code);
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  return "this program has as many files open as its limit allows, " + std::to_string(limit.rlim_cur);
}

Error system_error(const std::string& fact, int code, const std::string& advice, Kind kind,
                   std::vector<std::string> values) {
  const std::string sentence = fact + ": " + system_reason(code);
  if (code == EMFILE || code == ENFILE) return Error(sentence);
  return Error(sentence + advice, kind, std::move(values));
}

}  // namespace astro
