#include "host/commands/drive/drive_teleop_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/shared/robot_view.hpp"

namespace astro::commands {
namespace {

constexpr std::size_t kWide = 70;  // columns that the wide picture needs

constexpr const char* kWideKeys =
    "     W or ↑   faster                space   stop\n"
    "     S or ↓   slower, backwards     Q       quit\n"
    "     A or ←   turn left\n"
    "     D or →   turn right\n\n";
constexpr const char* kNarrowKeys =
    "  W or ↑   faster\n"
    "  S or ↓   slower, backwards\n"
    "  A or ←   turn left\n"
    "  D or →   turn right\n"
    "  space    stop\n"
    "  Q        quit\n\n";

// The rows of the picture without its explanation of the keys, and the one below it for the cursor.
constexpr std::size_t kOtherRows = 9;

// "" if the terminal has too few rows for them.
std::string keys_that_fit(console::TerminalSize terminal) {
  const std::string keys = terminal.columns >= kWide ? kWideKeys : kNarrowKeys;
  const auto rows = static_cast<std::size_t>(std::count(keys.begin(), keys.end(), '\n'));
  return rows + kOtherRows <= terminal.rows ? keys : "";
}

std::string gauge_that_fits(double fraction, std::size_t columns) {
  constexpr std::size_t kBeside = 37;  // columns of text on the same line
  constexpr int kLeastHalf = 2, kMostHalf = 15;
  const int half = static_cast<int>(columns > kBeside ? (columns - kBeside) / 2 : 0);
  return half < kLeastHalf ? "" : console::gauge(fraction, std::min(half, kMostHalf)) + "  ";
}

}  // namespace

std::string teleop_picture(const std::string& robot, const console::SteeringWheel& wheel,
                           const recording::OdometrySample& at, console::TerminalSize terminal) {
  const auto row = [&](const char* what, double fraction, double set, const char* unit, double is) {
    return fmt::format("  {:<8}  {}{:+5.2f} {:<5}  is {:+6.3f}\n", what,
                       gauge_that_fits(fraction, terminal.columns), without_minus_zero(set, 2), unit,
                       without_minus_zero(is, 3));
  };
  return fmt::format("\n  steering {}\n\n{}", robot, keys_that_fit(terminal)) +
         row("speed", wheel.forward(), wheel.v_mps(), "m/s", at.v_mps) +
         // Negative, so that a left turn points to the left.
         row("turning", -wheel.left(), wheel.omega_radps(), "rad/s", at.omega_radps) +
         fmt::format("\n  odometry  x {:.3f} m  y {:.3f} m{}heading {:.1f} deg\n",
                     without_minus_zero(at.x_m, 3), without_minus_zero(at.y_m, 3),
                     terminal.columns >= kWide ? "  " : "\n            ",
                     without_minus_zero(degrees(at.theta_rad), 1));
}

std::string teleop_keys() {
  return "W faster, S slower and backwards, A left, D right, space stop, Q quit; arrow keys work as well";
}

std::string teleop_line(const console::SteeringWheel& wheel, const recording::OdometrySample& at) {
  return fmt::format("{:+.2f} m/s  {:+.2f} rad/s  {}", without_minus_zero(wheel.v_mps(), 2),
                     without_minus_zero(wheel.omega_radps(), 2),
                     in_short_words({at.x_m, at.y_m, at.theta_rad}));
}

}  // namespace astro::commands
