#include "host/calibration/end_poses/odd_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/base/error.hpp"
#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"

namespace astro::calibration {
namespace {

/// Quantiles of chi-square with 2 and 3 degrees of freedom: an end without a mistake exceeds `odd` once in ten thousand, and
/// `fits` once in a hundred.
struct Bounds {
  double odd, fits;
};
Bounds bounds_of(const EndPose& end) {
  return std::isnan(end.theta_rad) ? Bounds{18.4, 9.2} : Bounds{21.1, 11.3};
}

using Mistakes = std::vector<Mistake>;

void add_decimal_points(Mistakes& list, const EndPose& typed) {
  for (const double shift : {1e-3, 1e-2, 1e-1, 1e1, 1e2, 1e3}) {
    list.push_back({"the decimal point of x", {shift * typed.x_m, typed.y_m, typed.theta_rad}});
    list.push_back({"the decimal point of y", {typed.x_m, shift * typed.y_m, typed.theta_rad}});
    list.push_back({"the decimal point of the heading", {typed.x_m, typed.y_m, shift * typed.theta_rad}});
    list.push_back({"another unit of length", {shift * typed.x_m, shift * typed.y_m, typed.theta_rad}});
  }
}

void add_signs(Mistakes& list, const EndPose& typed) {
  list.push_back({"the sign of x", {-typed.x_m, typed.y_m, typed.theta_rad}});
  list.push_back({"the sign of y", {typed.x_m, -typed.y_m, typed.theta_rad}});
  list.push_back({"the sign of the heading", {typed.x_m, typed.y_m, -typed.theta_rad}});
  list.push_back({"the signs of x and y", {-typed.x_m, -typed.y_m, typed.theta_rad}});
  list.push_back({"the signs of y and the heading", {typed.x_m, -typed.y_m, -typed.theta_rad}});
}

/// What may have been meant by what was typed.
Mistakes mistakes_of(const EndPose& typed) {
  Mistakes list;
  add_signs(list, typed);
  add_decimal_points(list, typed);
  list.push_back({"x and y exchanged", {typed.y_m, typed.x_m, typed.theta_rad}});
  list.push_back({"degrees for radians", {typed.x_m, typed.y_m, radians(typed.theta_rad)}});
  list.push_back({"radians for degrees", {typed.x_m, typed.y_m, degrees(typed.theta_rad)}});
  return list;
}

/// The mistake that explains the end best, if one explains it well. None if the other ends scatter so far that anything nearer
/// to zero would be explained.
std::optional<Mistake> mistake_in(const SquareEnd& end, Sense sense, const RobustFit& others,
                                  const SquareSetup& setup) {
  constexpr double kHidesMistakes = 4;  // ends twice as far apart as slip lets them be
  std::optional<Mistake> best;
  if (others.scatter > kHidesMistakes) return best;
  double least = bounds_of(end.measured).fits;
  for (Mistake& mistake : mistakes_of(end.measured)) {
    const double far =
        surprise_of(SquareEnd{mistake.meant, end.odometry}.error(), sense, others, setup).chi_square;
    if (!(far < least)) continue;
    least = far;
    best = std::move(mistake);
  }
  return best;
}

std::vector<EndPose> errors_of(std::span<const SquareEnd> ends) {
  std::vector<EndPose> errors;
  for (const SquareEnd& end : ends) errors.push_back(end.error());
  return errors;
}

struct AllEnds {
  std::vector<EndPose> cw, ccw;
  const SquareSetup& setup;

  RobustFit without(Sense sense, std::size_t index) const {
    const auto rest = [&](const std::vector<EndPose>& ends, bool leave_out) {
      std::vector<EndPose> others = ends;
      if (leave_out) others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
      return others;
    };
    return fit_ends(rest(cw, sense == Sense::cw), rest(ccw, sense == Sense::ccw), setup, RatioPrior{});
  }

  void judge(const SquareEnd& end, Sense sense, std::size_t index, std::vector<OddRun>& list) const {
    const RobustFit others = without(sense, index);
    const Surprise surprise = surprise_of(end.error(), sense, others, setup);
    if (surprise.chi_square <= bounds_of(end.measured).odd) return;
    const EndPose expected{surprise.expected.x_m + end.odometry.x_m, surprise.expected.y_m + end.odometry.y_m,
                           surprise.expected.theta_rad + end.odometry.theta_rad};
    list.push_back(
        {sense, index, end.measured, expected, surprise.chi_square, mistake_in(end, sense, others, setup)});
  }
};

/// Whether the ends of a direction agree with each other, whatever the model says of them.
bool agree(const std::vector<EndPose>& ends, Sense sense, const SquareSetup& setup) {
  RobustFit scatter;  // no ratios are fitted: only how much two ends differ counts
  return std::ranges::all_of(ends, [&](const EndPose& end) {
    const EndPose difference{end.x_m - ends[0].x_m, end.y_m - ends[0].y_m, end.theta_rad - ends[0].theta_rad};
    return surprise_of(difference, sense, scatter, setup).chi_square <= 2 * bounds_of(difference).odd;
  });
}

/// Removes the runs of a direction from the list if most of them are odd and all agree with each other, because then nobody
/// mistyped, but the robot or the person's axes are not as expected.
void forgive_all(std::vector<OddRun>& list, const std::vector<EndPose>& ends, Sense sense,
                 const SquareSetup& setup) {
  const auto is_of = [sense](const OddRun& odd) { return odd.sense == sense; };
  const auto odd = static_cast<std::size_t>(std::ranges::count_if(list, is_of));
  if (odd >= 2 && 2 * odd > ends.size() && agree(ends, sense, setup)) std::erase_if(list, is_of);
}

/// To a tenth, without zeros behind the point.
std::string shown(double value, const char* unit) {
  return fmt::format("{:.7g} {}", without_minus_zero(std::round(10 * value) / 10, 1), unit);
}

/// The numbers of an end that differ from `other`, or all of them.
std::string shown(const EndPose& end, const EndPose* other = nullptr) {
  std::string text;
  const auto add = [&](const char* name, const std::string& value) {
    text += (text.empty() ? "" : ", ") + std::string(name) + value;
  };
  if (other == nullptr || end.x_m != other->x_m) add("x = ", shown(1000 * end.x_m, "mm"));
  if (other == nullptr || end.y_m != other->y_m) add("y = ", shown(1000 * end.y_m, "mm"));
  if (!std::isnan(end.theta_rad) && (other == nullptr || end.theta_rad != other->theta_rad))
    add("heading ", shown(degrees(end.theta_rad), "degrees"));
  return text;
}

}  // namespace

EndPose SquareEnd::error() const { return difference(measured, odometry); }

std::vector<OddRun> odd_runs(std::span<const SquareEnd> cw, std::span<const SquareEnd> ccw,
                             const SquareSetup& setup) {
  const AllEnds all{errors_of(cw), errors_of(ccw), setup};
  std::vector<OddRun> list;
  try {
    for (std::size_t i = 0; i < cw.size(); ++i) all.judge(cw[i], Sense::cw, i, list);
    for (std::size_t i = 0; i < ccw.size(); ++i) all.judge(ccw[i], Sense::ccw, i, list);
  } catch (const Error&) {
    return {};
  }
  forgive_all(list, all.cw, Sense::cw, setup);
  forgive_all(list, all.ccw, Sense::ccw, setup);
  std::ranges::stable_sort(list, [](const OddRun& a, const OddRun& b) {
    return a.mistake.has_value() != b.mistake.has_value() ? a.mistake.has_value()
                                                          : a.chi_square > b.chi_square;
  });
  return list;
}

std::string described(const OddRun& odd) {
  EndPose expected = odd.expected;
  if (std::isnan(odd.measured.theta_rad)) expected.theta_rad = odd.measured.theta_rad;
  const std::string text =
      fmt::format("{}, and about {} is to be expected", shown(odd.measured), shown(expected));
  if (!odd.mistake) return text;
  return fmt::format("{}; {} would fit ({})", text, shown(odd.mistake->meant, &odd.measured),
                     odd.mistake->name);
}

}  // namespace astro::calibration
