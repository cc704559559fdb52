#include "host/commands/truth/truth_watch_view.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/base/text/degrees.hpp"

namespace astro::commands {
namespace {

std::string place_of(const truth::TrackerReport& report) {
  if (!report.pose) return "not seen";
  return fmt::format("x {:8.4f} m  y {:8.4f} m  {:7.2f} deg", report.pose->x_m, report.pose->y_m,
                     degrees(report.pose->theta_rad));
}

std::string noise_of(const truth::TrackerReport& report) {
  if (!report.rest) return report.pose ? "moves" : "";
  return fmt::format("noise {:.2f} mm {:.3f} deg", 1e3 * report.rest->position_m,
                     degrees(report.rest->heading_rad));
}

}  // namespace

std::string line_of(const truth::TrackerReport& report) {
  return fmt::format("{:6.1f} Hz  jitter {:.2f}/{:.2f} ms  gap {:.0f} ms  missing {}  lost {}  {}  {}",
                     report.rate_hz, 1e3 * report.sender.jitter_s, 1e3 * report.arrival.jitter_s,
                     1e3 * report.longest_gap_s, report.missing, report.lost, place_of(report),
                     noise_of(report));
}

nlohmann::json to_json(const truth::TrackerReport& report) {
  nlohmann::json json = {{"poses", report.poses},
                         {"lost", report.lost},
                         {"missing", report.missing},
                         {"rate_hz", report.rate_hz},
                         {"longest_gap_s", report.longest_gap_s},
                         {"sender_jitter_s", report.sender.jitter_s},
                         {"arrival_jitter_s", report.arrival.jitter_s},
                         {"pose", nullptr},
                         {"noise_at_rest", nullptr}};
  if (report.pose)
    json["pose"] = {
        {"x_m", report.pose->x_m}, {"y_m", report.pose->y_m}, {"theta_rad", report.pose->theta_rad}};
  if (report.rest)
    json["noise_at_rest"] = {{"position_m", report.rest->position_m},
                             {"heading_rad", report.rest->heading_rad}};
  return json;
}

}  // namespace astro::commands
