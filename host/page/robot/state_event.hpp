#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/protocol/telemetry.hpp"
#include "host/base/microseconds.hpp"

namespace astro::page {

/// What the event `state` says.
struct RobotState {
  bool open = false, armed = false;
  bool measuring = false;                        // the robot drives a measurement by itself, armed
  int driver = 0;                                // the page, or 0
  std::optional<protocol::Telemetry> telemetry;  // the newest; none while the link is lost
  std::string why_lost;                          // "" while the link is up
  std::string other_driver;                      // another program; "" if none is known
  std::string recording;                         // its file, or ""
  std::vector<std::string> recordings;           // that have ended, and that no page has removed
};

nlohmann::json to_json(const RobotState& state);

/// Says when the event is due: if anything but the battery's voltage has changed, and once a second.
class StateReport {
 public:
  /// The event, if it is due.
  std::optional<nlohmann::json> take(const RobotState& state, microseconds now);

 private:
  std::string told_;
  std::optional<microseconds> told_at_;
};

}  // namespace astro::page
