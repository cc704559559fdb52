#include "host/page/robot/state_event.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/safety/fault.hpp"
#include "common/safety/wheel_stopped.hpp"
#include "host/robot/client/fault_help.hpp"
#include "host/robot/client/refusal.hpp"

namespace astro::page {
namespace {

using nlohmann::json;

json faults_json(std::uint32_t latched) {
  json faults = json::array();
  for (unsigned i = 0; i < 32; ++i)
    if (const std::uint32_t one = latched & (1U << i))
      faults.push_back(
          {{"name", robot::fault_names(one)}, {"remedy", robot::fault_help(static_cast<Fault>(i))}});
  return faults;
}

json text_or_null(const std::string& text) { return text.empty() ? json(nullptr) : json(text); }

bool moves(const protocol::Telemetry& telemetry) {
  return protocol::gives_power(telemetry.state.mode) || !wheel_stopped(telemetry.wheel_speed.left_umps) ||
         !wheel_stopped(telemetry.wheel_speed.right_umps);
}

}  // namespace

json to_json(const RobotState& state) {
  json event{{"event", "state"},
             {"open", state.open},
             {"armed", state.armed},
             {"driver", state.driver},
             {"link", state.open && state.why_lost.empty() ? "up" : "lost"},
             {"why", text_or_null(state.why_lost)},
             {"other_driver", text_or_null(state.other_driver)},
             {"recording", text_or_null(state.recording)},
             {"recordings", state.recordings},
             {"mode", nullptr},
             {"moving", nullptr},
             {"faults", json::array()},
             {"battery_V", nullptr}};
  if (state.measuring) event["mode"] = "measuring", event["moving"] = true;
  if (!state.telemetry || state.measuring) return event;
  event["mode"] = protocol::name(state.telemetry->state.mode);
  event["moving"] = moves(*state.telemetry);
  event["faults"] = faults_json(state.telemetry->state.latched_faults);
  event["battery_V"] = std::round(state.telemetry->battery.mv / 10.0) / 100;
  return event;
}

std::optional<json> StateReport::take(const RobotState& state, microseconds now) {
  constexpr microseconds kBetween = std::chrono::seconds(1);
  json event = to_json(state);
  json compared = event;
  compared.erase("battery_V");
  const std::string text = compared.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text == told_ && told_at_ && now - *told_at_ < kBetween) return std::nullopt;
  told_ = text;
  told_at_ = now;
  return event;
}

}  // namespace astro::page
