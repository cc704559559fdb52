#include "host/calibration/motion/clock_search.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/calibration/motion/recorded_motion.hpp"
#include "host/calibration/motion/tracker_noise.hpp"

namespace astro::calibration {
namespace {

constexpr double kNearby_s = 1;
constexpr double kGoodEnough = 0.95;
constexpr double kMostSkew = 0.05;
// Number of pairs of bins to compare if every offset has to be tried. It takes a tenth of a second.
constexpr double kMostWork = 4e7;
// Laps of a drive take longer than this, so a repetition shows with bins of this size.
constexpr double kLapBin_s = 0.2;
// Twice a difference of log likelihoods: odds of e^10 to one.
constexpr double kSurely = 20;
constexpr std::size_t kMostPeaks = 4;

struct Candidate {
  ClockGuess guess;
  Agreement agreement;
};

bool better(const Candidate& a, const Candidate& b) {
  return a.agreement.correlation > b.agreement.correlation;
}

/// The search in one run, with the tracked body at one assumed place.
class Search {
 public:
  explicit Search(const RecordedMotion& motion)
      : motion_(motion),
        truth_is_longer_(motion.truth_span_s() > motion.wheel_span_s()),
        shorter_s_(std::min(motion.truth_span_s(), motion.wheel_span_s())),
        finest_s_(motion.finest_bin_s()),
        finest_(motion.match(finest_s_)) {}

  Candidate nearby(double skew) const {
    Candidate best;
    for (double offset_s = -kNearby_s; offset_s <= kNearby_s; offset_s += finest_s_)
      best = std::min(best, tried(finest_, {middle_s(), middle_s() - offset_s, skew}), better);
    return polished(finest_, best, false);
  }

  /// Local maxima of the correlation over the offset, separated by valleys; the best first.
  std::vector<Candidate> everywhere(std::optional<double> skew) const {
    const double bin_s = affordable_bin_s(skew.has_value());
    return refined(peaks(scan(bin_s, skew)), bin_s, !skew);
  }

  /// The same with coarse bins and one skew, to find laps that could be mistaken for one another.
  std::vector<Candidate> laps(double skew) const {
    const double bin_s = std::max(kLapBin_s, affordable_bin_s(true));
    return refined(peaks(scan(bin_s, skew)), bin_s, false);
  }

  /// By how much `one` explains the motion better, as twice a difference of log likelihoods.
  double advantage(const Candidate& one, const Candidate& other) const {
    const double samples = one.agreement.overlap_s / motion_.window().support_s();
    constexpr double kRounding = 1e-12;  // rounding leaves less than this, or nothing, of a perfect match
    return samples * std::log(std::max(kRounding, other.agreement.unexplained) /
                              std::max(kRounding, one.agreement.unexplained));
  }

  double offset_s(const ClockGuess& guess) const {
    return middle_s() - guess.truth_s - (middle_s() - guess.robot_s) / (1 + guess.skew);
  }

 private:
  double middle_s() const { return motion_.wheel_middle_s(); }

  static Candidate tried(const MotionMatch& match, const ClockGuess& guess) {
    return {guess, match.at(guess)};
  }

  /// The guess shifted by `offset_s`. The skew applies about the middle of the shorter recording.
  static Candidate moved(const MotionMatch& match, ClockGuess guess, double offset_s, double skew) {
    guess.robot_s += offset_s;
    guess.skew += skew;
    return tried(match, guess);
  }

  // The skew that moves the ends of the shorter recording by two bins.
  double skew_step(double bin_s) const { return 4 * bin_s / std::max(shorter_s_, 1.0); }

  double affordable_bin_s(bool skew_known) const {
    const double pairs = shorter_s_ * (motion_.truth_span_s() + motion_.wheel_span_s()) / 2;  // times bin^2
    const double skews = 2 * kMostSkew / skew_step(1);                                        // times bin
    return std::max(
        {finest_s_, std::sqrt(pairs / kMostWork), skew_known ? 0 : std::cbrt(pairs * skews / kMostWork)});
  }

  std::vector<Candidate> scan(double bin_s, std::optional<double> skew) const {
    const MotionMatch match = motion_.match(bin_s);
    const double from = skew.value_or(-kMostSkew), to = skew.value_or(kMostSkew), step = skew_step(bin_s);
    const double reach_s = (1 + kMostSkew) * (motion_.truth_span_s() + motion_.wheel_span_s()) / 2;
    std::vector<Candidate> scanned;
    for (double shift_s = -reach_s; shift_s <= reach_s; shift_s += 2 * bin_s) {
      const double truth_s = motion_.truth_middle_s();
      const ClockGuess middles = truth_is_longer_ ? ClockGuess{middle_s(), truth_s + shift_s, 0}
                                                  : ClockGuess{middle_s() + shift_s, truth_s, 0};
      Candidate best{middles, {}};
      for (double s = from; s <= to; s += step) best = std::min(best, moved(match, middles, 0, s), better);
      scanned.push_back(best);
    }
    return scanned;
  }

  static std::vector<Candidate> peaks(const std::vector<Candidate>& scanned) {
    const auto height = [&](std::size_t i) { return scanned[i].agreement.correlation; };
    std::vector<std::size_t> order;
    for (std::size_t i = 1; i + 1 < scanned.size(); ++i)
      if (height(i) > 0 && height(i) >= height(i - 1) && height(i) >= height(i + 1)) order.push_back(i);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
    std::vector<std::size_t> kept;
    for (const std::size_t i : order) {
      const bool apart = std::all_of(kept.begin(), kept.end(), [&](std::size_t other) {
        for (std::size_t k = std::min(i, other); k < std::max(i, other); ++k)
          if (height(k) < height(i) / 2) return true;
        return false;
      });
      if (apart) kept.push_back(i);
      if (kept.size() == kMostPeaks) break;
    }
    std::vector<Candidate> found;
    for (const std::size_t i : kept) found.push_back(scanned[i]);
    return found;
  }

  /// Refines the candidates with bins of half the size, until the bins are the finest.
  std::vector<Candidate> refined(std::vector<Candidate> found, double bin_s, bool free_skew) const {
    while (true) {
      bin_s = std::max(finest_s_, bin_s / 2);
      const MotionMatch match = bin_s == finest_s_ ? finest_ : motion_.match(bin_s);
      for (Candidate& candidate : found) {
        const ClockGuess around = candidate.guess;
        candidate = tried(match, around);
        const double step = skew_step(bin_s) / 2;
        for (int i = -4; i <= 4; ++i)
          for (int k = free_skew ? -4 : 0; k <= (free_skew ? 4 : 0); ++k)
            candidate = std::min(candidate, moved(match, around, i * bin_s, k * step), better);
        if (bin_s == finest_s_) candidate = polished(match, candidate, free_skew);
      }
      if (bin_s == finest_s_) break;
    }
    std::sort(found.begin(), found.end(), better);
    return found;
  }

  /// Moves the candidate to the maxima of parabolas through its neighbours.
  Candidate polished(const MotionMatch& match, const Candidate& found, bool free_skew) const {
    const auto top = [](double a, double b, double c) {
      const double bend = a - 2 * b + c;
      return bend < 0 ? std::clamp((a - c) / bend / 2, -1.0, 1.0) : 0;
    };
    const auto height = [&](double offset_s, double skew) {
      return moved(match, found.guess, offset_s, skew).agreement.correlation;
    };
    const double step_s = finest_s_, step = free_skew ? skew_step(finest_s_) / 2 : 0;
    const double b = found.agreement.correlation;
    const double by_s = step_s * top(height(-step_s, 0), b, height(step_s, 0));
    return std::min(found, moved(match, found.guess, by_s, step * top(height(0, -step), b, height(0, step))),
                    better);
  }

  const RecordedMotion& motion_;
  bool truth_is_longer_;
  double shorter_s_, finest_s_;
  MotionMatch finest_;  // with bins of finest_s_
};

ClockFit fit_of(const Search& search, const Candidate& found) {
  return {search.offset_s(found.guess),
          found.guess.skew,
          std::min(found.agreement.correlation, 1.0),
          found.agreement.likeness,
          {}};
}

bool apart(const Search& search, const Candidate& a, const Candidate& b) {
  return std::abs(search.offset_s(a.guess) - search.offset_s(b.guess)) > kNearby_s;
}

bool is_beaten(const Search& search, const Candidate& nearby) {
  const std::vector<Candidate> laps = search.laps(nearby.guess.skew);
  return std::any_of(laps.begin(), laps.end(), [&](const Candidate& lap) {
    return apart(search, lap, nearby) && search.advantage(lap, nearby) > kSurely;
  });
}

ClockFit search_everywhere(const Search& search, const Candidate& nearby, std::optional<double> skew) {
  std::vector<Candidate> found = search.everywhere(skew);
  found.push_back(nearby);
  const Candidate best = *std::min_element(found.begin(), found.end(), better);
  std::vector<Candidate> rivals;
  for (const Candidate& other : found)
    if (apart(search, other, best) && search.advantage(best, other) < kSurely) rivals.push_back(other);
  ClockFit fit = fit_of(search, best);
  if (rivals.empty() || std::abs(fit.offset_s) <= kNearby_s) return fit;
  for (const Candidate& rival : rivals)
    if (std::abs(search.offset_s(rival.guess)) <= kNearby_s) return fit_of(search, rival);
  fit.rival_offset_s = search.offset_s(rivals.front().guess);
  return fit;
}

}  // namespace

ClockFit search_clock(const Trajectory& run, double wheelbase_m, std::optional<double> skew) {
  // With headings the place of the body matters little, because they show the turning.
  std::vector<double> levers_m{0};
  if (!mostly_headings(run.truth)) levers_m.insert(levers_m.end(), {wheelbase_m / 2, 2 * wheelbase_m});
  std::vector<RecordedMotion> motions;
  for (const double lever_m : levers_m) motions.emplace_back(run, wheelbase_m, lever_m);
  std::vector<Candidate> nearby;
  for (const RecordedMotion& motion : motions) {
    const Search search(motion);
    nearby.push_back(search.nearby(skew.value_or(0)));
    if (nearby.back().agreement.correlation >= kGoodEnough && !is_beaten(search, nearby.back()))
      return fit_of(search, nearby.back());
  }
  ClockFit best;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const ClockFit fit = search_everywhere(Search(motions[i]), nearby[i], skew);
    if (i == 0 || fit.correlation > best.correlation) best = fit;
  }
  return best;
}

}  // namespace astro::calibration
