#include "host/calibration/end_poses/misfit.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "host/base/order_statistics.hpp"
#include "host/base/text/degrees.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"
#include "host/calibration/end_poses/end_scatter.hpp"
#include "host/calibration/end_poses/robust_weight.hpp"

namespace astro::calibration {
namespace {

using Ends = std::vector<EndPose>;

bool shows_heading(const EndPose& end) { return !std::isnan(end.theta_rad); }
double numbers_of(const EndPose& end) { return shows_heading(end) ? 3 : 2; }

/// All runs of both directions as they may have been meant.
struct Meaning {
  std::string mistake;
  Ends cw, ccw;
  double side_m = 0;
  double ln_density =
      0;  // of what was typed against that of what was meant, where the mistake changes the unit
};

/// The medians of the runs of a direction.
EndPose centre_of(const Ends& ends) {
  std::vector<double> x, y, theta;
  for (const EndPose& end : ends) {
    x.push_back(end.x_m);
    y.push_back(end.y_m);
    if (shows_heading(end)) theta.push_back(end.theta_rad);
  }
  return {median_of(std::move(x)), median_of(std::move(y)),
          theta.empty() ? std::numeric_limits<double>::quiet_NaN() : median_of(std::move(theta))};
}

/// In terms of the usual scatter of ends.
double apart(const EndPose& a, const EndPose& b, Sense sense, const SquareSetup& setup) {
  const EndPose difference{a.x_m - b.x_m, a.y_m - b.y_m, a.theta_rad - b.theta_rad};
  return surprise_of(difference, sense, RobustFit{}, setup).chi_square;
}

/// How far the centres are from where the best wheels and wheelbase bring them.
struct Lack {
  double ratio =
      std::numeric_limits<double>::infinity();  // of its variance to that which the scatter explains
  double freedom = 0;                           // of the scatter
  std::array<EndPose, 2> off;

  double most() const {
    // Of 1000 experiments that slip up to three times as far as usual none with five runs each way exceeds 27, and one with two
    // or three runs exceeds these. Single runs show no scatter; the usual one is taken, of which 55 was the most.
    constexpr double kLeast = 25, kSingleRuns = 60;
    return freedom > 0 ? std::max(kLeast, 800 / freedom) : kSingleRuns;
  }
};

Lack lack_of(const Ends& cw, const Ends& ccw, const SquareSetup& setup) {
  Lack lack;
  const EndPose centres[]{centre_of(cw), centre_of(ccw)};
  RobustFit fit = fit_ends({centres, 1}, {centres + 1, 1}, setup);
  fit.covariance.setZero();
  fit.scatter = 1;
  std::vector<Distance> distances;
  double numbers = 0, fitted = 0, sum = 0;
  for (const Sense sense : {Sense::cw, Sense::ccw}) {
    const Ends& ends = sense == Sense::cw ? cw : ccw;
    const std::size_t at = sense == Sense::cw ? 0 : 1;
    for (const EndPose& end : ends) {
      distances.push_back({apart(end, centres[at], sense, setup), numbers_of(end)});
      numbers += numbers_of(end);
    }
    fitted += numbers_of(centres[at]);
    const Surprise surprise = surprise_of(centres[at], sense, fit, setup);
    sum += static_cast<double>(ends.size()) * surprise.chi_square;
    lack.off[at] = {centres[at].x_m - surprise.expected.x_m, centres[at].y_m - surprise.expected.y_m,
                    centres[at].theta_rad - surprise.expected.theta_rad};
  }
  lack.freedom = std::max(0.0, numbers - fitted);
  lack.ratio = sum / (fitted - 2) / robust_scatter(distances, fitted);
  return lack;
}

double ln_determinants(const Ends& ends, Sense sense, double side_m, double b_m) {
  const Eigen::Matrix3d covariance = end_covariance(side_m, sense, b_m);
  double sum = 0;
  for (const EndPose& end : ends)
    sum += std::log(shows_heading(end) ? covariance.determinant()
                                       : covariance.topLeftCorner<2, 2>().determinant());
  return sum;
}

/// Log likelihood of ends with the tails of robust_weight and the best scatter. The prior of the scatter, 1 with the weight of
/// four numbers, keeps two ends that happen to agree from being infinitely likely.
double ln_density_of(const std::vector<Distance>& distances, double scatter) {
  constexpr double kPrior = 4, kTails = 6;
  constexpr int kIterations = 30;
  for (int i = 0; i < kIterations; ++i) {
    double squares = kPrior, numbers = kPrior;
    for (const Distance& one : distances) {
      squares += (kTails + one.count) / (kTails + one.square / scatter) * one.square;
      numbers += one.count;
    }
    scatter = squares / numbers;
  }
  double sum = -kPrior / 2 * (std::log(scatter) + 1 / scatter);
  for (const Distance& one : distances)
    sum -= one.count / 2 * std::log(scatter) +
           (kTails + one.count) / 2 * std::log(1 + one.square / (kTails * scatter));
  return sum;
}

/// Log likelihood of the ends with the best wheels, wheelbase and slip.
double ln_likelihood(const Meaning& meaning, const WheelFactors& loaded) {
  const SquareSetup setup{meaning.side_m, loaded};
  try {
    RobustFit fit = fit_ends(meaning.cw, meaning.ccw, setup);
    const double scatter = fit.scatter;
    fit.covariance.setZero();
    fit.scatter = 1;
    std::vector<Distance> distances;
    for (const Sense sense : {Sense::cw, Sense::ccw})
      for (const EndPose& end : sense == Sense::cw ? meaning.cw : meaning.ccw)
        distances.push_back({surprise_of(end, sense, fit, setup).chi_square, numbers_of(end)});
    return meaning.ln_density + ln_density_of(distances, scatter) -
           (ln_determinants(meaning.cw, Sense::cw, meaning.side_m, loaded.b_m) +
            ln_determinants(meaning.ccw, Sense::ccw, meaning.side_m, loaded.b_m)) /
               2;
  } catch (const Error&) {
    return -std::numeric_limits<double>::infinity();
  }
}

/// A mistake in the same column of all runs, of both directions or of one.
struct ColumnMistake {
  const char* name;
  EndPose (*meant)(const EndPose&);
  double typed_per_meant = 1;  // of the headings
};

constexpr double kDegree = radians(1);
constexpr ColumnMistake kColumnMistakes[]{{"x had the other sign",
                                           [](const EndPose& end) {
                                             return EndPose{-end.x_m, end.y_m, end.theta_rad};
                                           }},
                                          {"y had the other sign",
                                           [](const EndPose& end) {
                                             return EndPose{end.x_m, -end.y_m, end.theta_rad};
                                           }},
                                          {"the heading had the other sign",
                                           [](const EndPose& end) {
                                             return EndPose{end.x_m, end.y_m, -end.theta_rad};
                                           }},
                                          {"x and y were exchanged",
                                           [](const EndPose& end) {
                                             return EndPose{end.y_m, end.x_m, end.theta_rad};
                                           }},
                                          {"the headings were in degrees",
                                           [](const EndPose& end) {
                                             return EndPose{end.x_m, end.y_m, kDegree * end.theta_rad};
                                           },
                                           1 / kDegree},
                                          {"the headings were in radians",
                                           [](const EndPose& end) {
                                             return EndPose{end.x_m, end.y_m, end.theta_rad / kDegree};
                                           },
                                           kDegree}};

void correct(const ColumnMistake& mistake, Ends& ends, Meaning& meaning) {
  for (EndPose& end : ends) {
    if (shows_heading(end)) meaning.ln_density -= std::log(mistake.typed_per_meant);
    end = mistake.meant(end);
  }
}

/// The side with which headings and positions would be in proportion: x = -L theta / 2 = y clockwise, x = L theta / 2 = -y
/// counter-clockwise. Nothing if no side makes them so.
std::optional<double> side_shown(const Ends& cw, const Ends& ccw) {
  const EndPose a = centre_of(cw), b = centre_of(ccw);
  if (!shows_heading(a) || !shows_heading(b)) return std::nullopt;
  const double side_m = ((b.x_m - b.y_m) * b.theta_rad - (a.x_m + a.y_m) * a.theta_rad) /
                        (a.theta_rad * a.theta_rad + b.theta_rad * b.theta_rad);
  return side_m > 0.1 && side_m < 100 ? std::optional(side_m) : std::nullopt;
}

std::vector<Meaning> meanings_of(const Meaning& typed) {
  std::vector<Meaning> list{{"the directions were exchanged", typed.ccw, typed.cw, typed.side_m}};
  for (const ColumnMistake& mistake : kColumnMistakes)
    for (const char* where : {"", " in the clockwise runs", " in the counter-clockwise runs"}) {
      Meaning meaning = typed;
      meaning.mistake = std::string(mistake.name) + where;
      if (where != std::string_view(" in the counter-clockwise runs")) correct(mistake, meaning.cw, meaning);
      if (where != std::string_view(" in the clockwise runs")) correct(mistake, meaning.ccw, meaning);
      list.push_back(std::move(meaning));
    }
  if (const auto side_m = side_shown(typed.cw, typed.ccw))
    list.push_back({fmt::format("the side was {:.2g} m", *side_m), typed.cw, typed.ccw, *side_m});
  return list;
}

/// The mistakes that make the ends far more likely, and nearly as likely as the best of them does.
std::vector<std::string> mistakes_in(const Meaning& typed, const WheelFactors& loaded) {
  constexpr double kClearly = 15, kAlike = 3;  // of the log likelihood
  constexpr std::size_t kMost = 3;
  const double as_typed = ln_likelihood(typed, loaded);
  if (!std::isfinite(as_typed)) return {};  // the estimate says so
  std::vector<std::pair<double, std::string>> found;
  for (Meaning& meaning : meanings_of(typed))
    found.emplace_back(ln_likelihood(meaning, loaded), std::move(meaning.mistake));
  std::ranges::stable_sort(found, std::greater(), [](const auto& one) { return one.first; });
  std::vector<std::string> names;
  const double least = std::max(found.front().first - kAlike, as_typed + kClearly);
  for (const auto& [likelihood, name] : found)
    if (likelihood >= least && names.size() < kMost) names.push_back(name);
  return names;
}

bool are_same(std::span<const EndPose> cw, std::span<const EndPose> ccw) {
  const auto same = [](const EndPose& a, const EndPose& b) {
    return a.x_m == b.x_m && a.y_m == b.y_m &&
           (a.theta_rad == b.theta_rad || (!shows_heading(a) && !shows_heading(b)));
  };
  // A simulation without noise may have a robot whose ends are all zero.
  const bool moved = std::ranges::any_of(cw, [](const EndPose& end) { return end.x_m != 0 || end.y_m != 0; });
  return moved && std::ranges::equal(cw, ccw, same);
}

std::string off_text(const EndPose& off) {
  const std::string text = fmt::format("{:.0f} mm", 1000 * std::hypot(off.x_m, off.y_m));
  return shows_heading(off) ? fmt::format("{} and {:.1f} degrees", text, degrees(std::abs(off.theta_rad)))
                            : text;
}

}  // namespace

std::optional<Remark> misfit_of(std::span<const EndPose> cw, std::span<const EndPose> ccw,
                                const SquareSetup& setup) {
  if (cw.empty() || ccw.empty()) return std::nullopt;
  if (are_same(cw, ccw))
    return Remark{"the clockwise and the counter-clockwise runs are the same numbers",
                  EndPoseProblem::same_runs};
  const Meaning typed{"", {cw.begin(), cw.end()}, {ccw.begin(), ccw.end()}, setup.side_m};
  const std::vector<std::string> mistakes = mistakes_in(typed, setup.loaded);
  const std::string fact = "no wheels and no wheelbase bring the robot to these ends";
  if (!mistakes.empty()) {
    std::string text;
    for (const std::string& one : mistakes) text += (text.empty() ? "" : ", or if ") + one;
    return Remark{fact + "; they would fit if " + text, EndPoseProblem::misfit_with_mistake, mistakes};
  }
  Lack lack;
  try {
    lack = lack_of(typed.cw, typed.ccw, setup);
  } catch (const Error&) {
    return std::nullopt;  // the estimate says so
  }
  if (lack.ratio <= lack.most()) return std::nullopt;
  return Remark{fmt::format("{}: the centre of the clockwise runs is {} off, that of the counter-clockwise "
                            "runs {}; check the side, the "
                            "units and signs of the columns, and which runs are of which direction",
                            fact, off_text(lack.off[0]), off_text(lack.off[1])),
                EndPoseProblem::misfit};
}

}  // namespace astro::calibration
