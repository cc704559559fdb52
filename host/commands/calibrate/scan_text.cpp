#include "host/commands/calibrate/scan_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "host/base/text/columns.hpp"
#include "host/base/text/degrees.hpp"
#include "host/console/console.hpp"
#include "host/experiment/analysis/likelihood_sentences.hpp"
#include "host/import/scans/scan_result.hpp"

namespace astro::commands {
namespace {

using importing::diameter_ratio;
using importing::mean_scale;
using importing::standard_error;
using lidar::ScanCalibration;

/// "E_d and b", of a set as SGE.
std::string factors_in(std::string_view set) {
  std::vector<std::string> names;
  for (const char one : set) names.emplace_back(one == 'S' ? "the scale" : one == 'G' ? "b / S" : "E_d");
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::string scan_result_text(const ScanCalibration& found) {
  using experiment::with_error;
  const calibration::WheelFactors &factors = found.factors, &loaded = found.loaded;
  const std::vector<std::vector<std::string>> rows{
      {"", "loaded", "found"},
      {"c_R", fmt::format("{:.8f}", loaded.c_r), with_error(factors.c_r, standard_error(found, 0), 8)},
      {"c_L", fmt::format("{:.8f}", loaded.c_l), with_error(factors.c_l, standard_error(found, 1), 8)},
      {"b mm", fmt::format("{:.4f}", 1000 * loaded.b_m),
       with_error(1000 * factors.b_m, 1000 * standard_error(found, 2), 4)},
      {"E_d", fmt::format("{:.7f}", diameter_ratio(loaded)),
       with_error(diameter_ratio(factors), diameter_ratio(factors) * importing::diameter_ratio_error(found),
                  7)},
      {"S", fmt::format("{:.8f}", mean_scale(loaded)), fmt::format("{:.8f}", mean_scale(factors))}};
  const lidar::ScanCounts& counts = found.counts;
  std::string text = fmt::format(
      "{} scans, of which {} pairs were matched. The scanner sits {:.0f} mm ahead and {:.0f} mm to the left "
      "of "
      "the middle (± {:.0f} and {:.0f} mm) and looks {:.2f} degrees to the left (± {:.2f}).",
      counts.scans, counts.matched, 1000 * found.scanner.x_m, 1000 * found.scanner.y_m,
      1000 * found.scanner_se.x_m, 1000 * found.scanner_se.y_m, degrees(wrapped_rad(found.scanner.theta_rad)),
      degrees(found.scanner_se.theta_rad));
  if (std::isfinite(found.late_se_s))
    text += fmt::format(" Its stamps are {:.1f} ms late (± {:.1f} ms).", 1000 * found.late_s,
                        1000 * found.late_se_s);
  if (!found.choice.set.name.empty())
    text +=
        fmt::format(" These factors help on pieces that were not used to find them, and were changed: {}.",
                    factors_in(found.choice.set.name));
  return console::table(rows) + '\n' + wrapped(text) + wrapped(importing::verdict_sentence(found));
}

}  // namespace astro::commands
