#include "host/truth/manual/manual_source.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "host/base/numbers.hpp"
#include "host/recording/run/run_metadata.hpp"
#include "host/truth/source/plausibility.hpp"

namespace astro::truth {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Two NaNs count as the same.
bool same_reading(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

double ManualSource::number(const std::string& prompt, bool may_be_empty, const std::string& hint) {
  Question question{hint + prompt};
  while (true) {
    const std::string answer = trimmed(ask_(question));
    if (answer.empty() && may_be_empty) return std::numeric_limits<double>::quiet_NaN();
    if (const auto value = typed_number(answer)) return *value;
    question = {". " + prompt, {"'" + answer + "' is not a number", {Help::write_decimal_point}}};
  }
}

recording::TruthSample ManualSource::measured(const std::string& hint) {
  recording::TruthSample end;
  end.x_m = number("measured end x (m, forward of the start): ", false, hint);
  end.y_m = number("measured end y (m, left of the start): ", false);
  end.theta_rad = number("measured end heading (degrees, counter-clockwise; empty: not measured): ", true) *
                  std::numbers::pi / 180;
  return end;
}

std::vector<recording::TruthSample> ManualSource::complete(const recording::Run& run) {
  recording::TruthSample end = measured("");
  while (true) {
    const std::string why = implausible_end(run, {}, end);
    if (why.empty()) break;
    const recording::TruthSample again = measured(recording::run_name(run.info) + ": " + why +
                                                  " It is asked for again; the same values keep them.\n");
    const bool same = same_reading(again.x_m, end.x_m) && same_reading(again.y_m, end.y_m) &&
                      same_reading(again.theta_rad, end.theta_rad);
    end = again;
    if (same) break;
  }
  return at_both_ends(run, {}, end);
}

std::vector<recording::TruthSample> at_both_ends(const recording::Run& run,
                                                 const recording::TruthSample& start,
                                                 const recording::TruthSample& end, std::int64_t stretch_us) {
  std::vector<recording::TruthSample> samples;
  for (const recording::OdometrySample& odometry : run.odometry) {
    const bool early = odometry.time_us - run.odometry.front().time_us <= stretch_us;
    const bool late = run.odometry.back().time_us - odometry.time_us <= stretch_us;
    if (!early && !late) continue;
    recording::TruthSample sample = early ? start : end;
    sample.time_us = odometry.time_us;
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace astro::truth
