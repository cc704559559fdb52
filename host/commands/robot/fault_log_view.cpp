#include "host/commands/robot/fault_log_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/protocol/enums.hpp"
#include "common/safety/fault.hpp"
#include "host/base/text/shown.hpp"
#include "host/console/console.hpp"

namespace astro::commands {
namespace {

using Entries = std::span<const protocol::FaultLogEntry>;

/// Newer firmware may have written numbers for which this version has no name.
template <class E>
std::string name_or_number(std::uint8_t value) {
  const std::string_view found = name(static_cast<E>(value));
  return found == "?" ? fmt::format("unknown ({})", value) : std::string(found);
}

std::string volts(std::int32_t mv) { return fmt::format("{:.2f} V", mv / 1e3); }
std::string speed(std::int32_t umps) { return fmt::format("{:.3f} m/s", without_minus_zero(umps / 1e6, 3)); }

}  // namespace

std::string fault_log_table(Entries entries) {
  if (entries.empty()) return "the fault log is empty: no fault has stopped this robot yet\n";
  const bool any_missed = std::ranges::any_of(entries, [](const auto& entry) { return entry.missed != 0; });
  std::vector<std::vector<std::string>> rows{
      {"number", "start", "after", "fault", "in mode", "battery", "left", "right"}};
  if (any_missed) rows[0].push_back("not logged before it");
  for (const protocol::FaultLogEntry& entry : entries) {
    rows.push_back({std::to_string(entry.number), std::to_string(entry.start),
                    duration_in_words(entry.device_time_us), name_or_number<Fault>(entry.fault),
                    name_or_number<protocol::Mode>(entry.mode), volts(entry.battery_mv),
                    speed(entry.left_umps), speed(entry.right_umps)});
    if (any_missed) rows.back().push_back(entry.missed == 0 ? "" : std::to_string(entry.missed));
  }
  return console::table(rows, "rrrllrrrr");
}

Json fault_log_json(Entries entries) {
  Json json = Json::array();
  for (const protocol::FaultLogEntry& entry : entries) {
    json.push_back({{"number", entry.number},
                    {"start", entry.start},
                    {"time_s", static_cast<double>(entry.device_time_us) / 1e6},
                    {"fault", name_or_number<Fault>(entry.fault)},
                    {"mode", name_or_number<protocol::Mode>(entry.mode)},
                    {"battery_V", entry.battery_mv / 1e3},
                    {"left_mps", entry.left_umps / 1e6},
                    {"right_mps", entry.right_umps / 1e6},
                    {"missed", entry.missed}});
  }
  return json;
}

}  // namespace astro::commands
