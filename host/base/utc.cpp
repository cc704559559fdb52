#include "host/base/utc.hpp"

#include <fmt/chrono.h>
#include <time.h>

#include <ctime>

namespace astro {

std::string utc_text(UtcTime time) {
  const std::time_t seconds = std::chrono::floor<std::chrono::seconds>(time).time_since_epoch().count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(seconds));
}

std::string utc_now() {
  return utc_text(std::chrono::floor<std::chrono::microseconds>(std::chrono::system_clock::now()));
}

std::optional<UtcTime> utc_time(const std::string& text) {
  std::tm time{};
  const char* const end = strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &time);
  if (end == nullptr || *end != '\0') return std::nullopt;
  const std::time_t seconds = timegm(&time);
  if (seconds < 0) return std::nullopt;
  return UtcTime(std::chrono::seconds(seconds));
}

}  // namespace astro
