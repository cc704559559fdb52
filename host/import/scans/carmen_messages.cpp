#include "host/import/scans/carmen_messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "host/base/text/numbers.hpp"

namespace astro::importing {
namespace {

constexpr double kHalfTurn_rad = std::numbers::pi, kTurn_rad = 2.01 * kHalfTurn_rad;  // rounded

/// Calls `handle` with each line.
template <class Handle>
void each_line(std::string_view text, Handle handle) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    handle(text.substr(0, end));
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

/// The words of a line as numbers.
class Fields {
 public:
  explicit Fields(std::string_view line) : rest_(line) { word(); }

  bool ok() const { return ok_; }
  void require(bool condition) { ok_ = ok_ && condition; }
  double number() {
    const std::string_view text = word();
    const std::optional<double> value = text.empty() ? std::nullopt : number_in(text);
    if (value && std::isfinite(*value)) return *value;
    ok_ = false;
    return 0;
  }
  std::size_t count() {
    constexpr double kMost = 100'000;
    const double value = number();
    if (value < 0 || value > kMost || value != std::floor(value)) ok_ = false;
    return ok_ ? static_cast<std::size_t>(value) : 0;
  }
  Pose2 pose() {
    const double x_m = number(), y_m = number();
    return {x_m, y_m, number()};
  }

 private:
  std::string_view word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r"), rest_.size()));
    const std::string_view found = rest_.substr(0, rest_.find_first_of(" \t\r"));
    rest_.remove_prefix(found.size());
    return found;
  }

  std::string_view rest_;
  bool ok_ = true;
};

void read_ranges(Fields& fields, std::size_t count, lidar::Scan& scan) {
  scan.ranges_m.reserve(count);
  constexpr double kMost_m = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < count && fields.ok(); ++i)
    scan.ranges_m.push_back(static_cast<float>(std::clamp(fields.number(), -kMost_m, kMost_m)));
}

CarmenMessage laser_of(Fields& fields) {
  CarmenMessage message;
  message.is_scan = true;
  const std::size_t count = fields.count();
  if (count < 2) return message;
  message.scan.first_angle_rad = -kHalfTurn_rad / 2;
  message.scan.angle_step_rad = kHalfTurn_rad / static_cast<double>(count - count % 2);
  read_ranges(fields, count, message.scan);
  fields.pose();  // of the scanner
  message.robot = fields.pose();
  return message;
}

/// ROBOTLASER1 type first_angle field_of_view step maximum accuracy remission_mode n range[1..n] m remission[1..m]
/// scanner's pose, robot's pose
CarmenMessage robot_laser_of(Fields& fields) {
  CarmenMessage message;
  message.is_scan = true;
  fields.number();
  message.scan.first_angle_rad = fields.number();
  fields.number();
  message.scan.angle_step_rad = fields.number();
  fields.require(std::abs(message.scan.first_angle_rad) <= kTurn_rad && message.scan.angle_step_rad != 0 &&
                 std::abs(message.scan.angle_step_rad) <= kTurn_rad);
  message.scan.range_max_m = fields.number();
  fields.number();
  fields.number();
  read_ranges(fields, fields.count(), message.scan);
  for (std::size_t left = fields.count(); left > 0 && fields.ok(); --left) fields.number();
  fields.pose();
  message.robot = fields.pose();
  return message;
}

bool begins(std::string_view line, std::string_view word) {
  return line.starts_with(word) && line.size() > word.size() && line[word.size()] == ' ';
}

}  // namespace

bool is_carmen_log(std::string_view text) {
  constexpr int kLines = 300;
  int line_number = 0;
  bool found = false;
  each_line(text.substr(0, 1 << 20), [&](std::string_view line) {
    if (++line_number > kLines) return;
    for (const std::string_view word : {"ODOM", "FLASER", "ROBOTLASER1"})
      if (begins(line, word)) found = true;
    found = found || line.starts_with("# message formats defined:");
  });
  return found;
}

std::string_view carmen_laser(std::string_view text) {
  bool front = false;
  each_line(text, [&](std::string_view line) { front = front || begins(line, "FLASER"); });
  return front ? "FLASER" : "ROBOTLASER1";
}

std::size_t each_carmen_message(std::string_view text, std::string_view laser,
                                const std::function<void(CarmenMessage&)>& handle) {
  std::size_t damaged = 0;
  each_line(text, [&](std::string_view line) {
    if (begins(line, "NEFF")) {
      CarmenMessage end{false, true, {}, {}};
      return handle(end);
    }
    const bool scan = begins(line, laser);
    if (!scan && !begins(line, "ODOM")) return;
    Fields fields(line);
    CarmenMessage message = !scan               ? CarmenMessage{false, false, fields.pose(), {}}
                            : laser == "FLASER" ? laser_of(fields)
                                                : robot_laser_of(fields);
    if (!fields.ok() || (scan && message.scan.ranges_m.empty())) {
      ++damaged;
      return;
    }
    handle(message);
  });
  return damaged;
}

}  // namespace astro::importing
