#include "host/calibration/motion/clock_step.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "host/base/order_statistics.hpp"
#include "host/calibration/motion/motion_profile.hpp"
#include "host/calibration/motion/recorded_motion.hpp"

namespace astro::calibration {
namespace {

constexpr double kLongestStep_s = 2.5, kSmallestStep_s = 0.06;
// One offset may drift this fast, also beyond the skew that was found for the drive, before two offsets are believed; where the
// stamps show the step as well, only this fast, which is ten times what quartz clocks do.
constexpr double kMostDrift = 0.02, kMostDriftBesideLeap = 5e-3;
// Sums of errors over blocks, of which a drive has no more than this.
constexpr int kMostBlocks = 500;
constexpr double kShortestBlock_s = 0.25;
// Twice a difference of log likelihoods: of two offsets against one, and of a part's own offset against the other part's.
// The moment of a step is free, so chance finds more than it would at a given one.
constexpr double kPerhaps = 20, kStepped = 60;
// The stretch in which a step may lie: odds of e^4 to one.
constexpr double kMayLie = 8;

using Errors = Eigen::ArrayXXd;  // a column for each block, a row for each offset

double rms(const std::vector<double>& values, const std::vector<char>& known) {
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!known[i]) continue;
    sum += values[i] * values[i];
    ++n;
  }
  return n > 0 ? std::sqrt(sum / n) : 0;
}

/// Calls `leap` with the bins, begin..end-1, whose speeds a leap between two samples' times touches.
void for_each_leap(const auto& samples, double reach_s, const MotionProfile& profile, const auto& leap) {
  const double longest_s = 2.5 * median_period_s(samples);
  const auto bin = [&](double time_s) {
    const double at = (time_s - profile.first_s) / profile.bin_s;
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(profile.known.size())));
  };
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double from_s = samples[k - 1].time_s, to_s = samples[k].time_s;
    if (to_s - from_s <= longest_s) continue;
    leap(bin(from_s - reach_s + profile.bin_s), bin(to_s + reach_s + profile.bin_s));
  }
}

/// Within a leap a profile holds the mean of what nobody saw. The truth's bins there do not count, and the wheels go on from the
/// speed before it to that after it.
void forget_leaps(const Trajectory& run, double reach_s, MotionProfile& wheels, MotionProfile& truth) {
  for_each_leap(run.truth, reach_s, truth, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) truth.known[i] = false;
  });
  for_each_leap(run.wheels, reach_s, wheels, [&](std::size_t begin, std::size_t end) {
    if (begin == 0 || end >= wheels.known.size()) return;
    for (std::vector<double>* values : {&wheels.speed_mps, &wheels.turn_mps})
      for (std::size_t i = begin; i < end; ++i) {
        const double part = static_cast<double>(i + 1 - begin) / static_cast<double>(end + 1 - begin);
        (*values)[i] = (1 - part) * (*values)[begin - 1] + part * (*values)[end];
      }
  });
}

/// The time that the wheels' recording covers. Wheels that stand at one of its ends are taken to stand beyond it, too; nobody
/// knows what wheels did that moved there.
struct Covered {
  double first_s = 0, last_s = 0;
  bool stood_before = false, stood_after = false;

  explicit Covered(const MotionProfile& wheels)
      : first_s(wheels.first_s),
        last_s(wheels.first_s + static_cast<double>(wheels.known.size() - 1) * wheels.bin_s) {
    constexpr double kEnd_s = 0.5, kStands = 0.1;
    const double limit = kStands * (rms(wheels.speed_mps, wheels.known) + rms(wheels.turn_mps, wheels.known));
    const std::size_t size = wheels.known.size(),
                      end = std::min(size, static_cast<std::size_t>(std::ceil(kEnd_s / wheels.bin_s)));
    const auto stands = [&](std::size_t from) {
      for (std::size_t i = from; i < from + end; ++i)
        if (wheels.speed_mps[i] + wheels.turn_mps[i] > limit) return false;
      return true;
    };
    stood_before = stands(0);
    stood_after = stands(size - end);
  }

  bool has(double time_s, double reach_s) const {
    return time_s >= first_s + (stood_before ? 0 : reach_s) && time_s <= last_s - (stood_after ? 0 : reach_s);
  }
};

/// How badly each block of a drive fits the wheels at each offset about the clock's.
class Offsets {
 public:
  Offsets(const Trajectory& run, const ClockFit& clock, double wheelbase_m) : offset_s_(clock.offset_s) {
    const RecordedMotion motion(run, wheelbase_m, 0);
    bin_s_ = motion.finest_bin_s();
    support_s_ = motion.window().support_s();
    MotionProfile wheels = motion.wheels(bin_s_), truth = motion.truth(bin_s_);
    forget_leaps(run, support_s_ / 2, wheels, truth);
    forget_uncovered(wheels, truth);
    scale(wheels, truth);
    sum_up(wheels, truth);
  }

  int blocks() const { return static_cast<int>(errors_.cols()); }
  int offsets() const { return static_cast<int>(errors_.rows()); }
  double offset_s(int row) const { return (row - offsets() / 2) * bin_s_; }
  double block_begin_s(int block) const { return first_s_ + block * block_s_; }
  double span_s() const { return blocks() * block_s_; }
  double bin_s() const { return bin_s_; }
  /// Independent errors.
  double samples() const { return known_ * bin_s_ / support_s_; }

  /// The errors of each block at offsets that change by `skew` about the middle.
  Errors at(double skew) const {
    if (skew == 0) return errors_;
    Errors sheared(errors_.rows(), errors_.cols());
    for (Eigen::Index block = 0; block < errors_.cols(); ++block) {
      const double ahead_s = skew * (static_cast<double>(block) + 0.5 - blocks() / 2.0) * block_s_;
      const auto rows = static_cast<Eigen::Index>(std::lround(ahead_s / bin_s_));
      for (Eigen::Index row = 0; row < errors_.rows(); ++row)
        sheared(row, block) = errors_(std::clamp<Eigen::Index>(row + rows, 0, errors_.rows() - 1), block);
    }
    return sheared;
  }

 private:
  /// Where the wheels are not known at each offset, the truth's bins do not count.
  void forget_uncovered(const MotionProfile& wheels, MotionProfile& truth) const {
    const Covered covered(wheels);
    for (std::size_t i = 0; i < truth.known.size(); ++i) {
      const double time_s = truth.first_s + static_cast<double>(i) * bin_s_ + offset_s_;
      if (!covered.has(time_s, kLongestStep_s + support_s_ / 2)) truth.known[i] = false;
    }
  }

  /// The wheels' speeds in the truth's size, so that wrong sizes of the robot do not count.
  static void scale(MotionProfile& wheels, const MotionProfile& truth) {
    const auto scaled = [&](std::vector<double>& values, const std::vector<double>& like) {
      const double now = rms(values, wheels.known), wanted = rms(like, truth.known);
      for (double& value : values) value *= now > 0 ? wanted / now : 0;
    };
    scaled(wheels.speed_mps, truth.speed_mps);
    scaled(wheels.turn_mps, truth.turn_mps);
  }

  void sum_up(const MotionProfile& wheels, const MotionProfile& truth) {
    const auto reach = static_cast<Eigen::Index>(std::lround(kLongestStep_s / bin_s_));
    const Eigen::Index rows = 2 * reach + 1;
    first_s_ = truth.first_s;
    const double span_s = static_cast<double>(truth.known.size()) * bin_s_;
    const auto bins =
        static_cast<std::size_t>(std::ceil(std::max(kShortestBlock_s, span_s / kMostBlocks) / bin_s_));
    block_s_ = static_cast<double>(bins) * bin_s_;
    errors_ = Errors::Zero(rows, static_cast<Eigen::Index>((truth.known.size() + bins - 1) / bins));
    // A robot that stands at the end of its samples is taken to stand beyond them. Where it moves, forget_uncovered leaves out the
    // bins that would be compared with these zeros.
    const Eigen::Index margin = rows + 1, size = std::ssize(wheels.known);
    Eigen::ArrayXd speed = Eigen::ArrayXd::Zero(size + 2 * margin), turn = speed;
    speed.segment(margin, size) = Eigen::ArrayXd::Map(wheels.speed_mps.data(), size);
    turn.segment(margin, size) = Eigen::ArrayXd::Map(wheels.turn_mps.data(), size);
    for (std::size_t i = 0; i < truth.known.size(); ++i) {
      if (!truth.known[i]) continue;
      const double time_s = truth.first_s + static_cast<double>(i) * bin_s_;
      const double at = (time_s + offset_s_ - wheels.first_s) / bin_s_ + static_cast<double>(margin - reach);
      const auto from = static_cast<Eigen::Index>(std::floor(at));
      if (from < 0 || from + rows >= speed.size()) continue;
      const double part = at - std::floor(at);
      const auto wheel = [&](const Eigen::ArrayXd& all) {
        return (1 - part) * all.segment(from, rows) + part * all.segment(from + 1, rows);
      };
      errors_.col(static_cast<Eigen::Index>(i / bins)) +=
          (wheel(speed) - truth.speed_mps[i]).square() + (wheel(turn) - truth.turn_mps[i]).square();
      ++known_;
    }
  }

  const double offset_s_;
  double bin_s_ = 0, support_s_ = 0, first_s_ = 0, block_s_ = 0, known_ = 0;
  Errors errors_;
};

/// Two offsets, and the first block of the second.
struct Split {
  double error = std::numeric_limits<double>::infinity();
  int block = 0;
  Eigen::Index before = 0, after = 0;  // rows
};

/// The sums over the blocks before each one; a last column for all.
Errors running(const Errors& errors) {
  Errors sums(errors.rows(), errors.cols() + 1);
  sums.col(0).setZero();
  for (Eigen::Index i = 0; i < errors.cols(); ++i) sums.col(i + 1) = sums.col(i) + errors.col(i);
  return sums;
}

Split best_split(const Errors& sums) {
  Split best;
  const Eigen::Index all = sums.cols() - 1;
  for (Eigen::Index i = 1; i < all; ++i) {
    Eigen::Index before = 0, after = 0;
    const double error = sums.col(i).minCoeff(&before) + (sums.col(all) - sums.col(i)).minCoeff(&after);
    if (error < best.error) best = {error, static_cast<int>(i), before, after};
  }
  return best;
}

/// The offset at the least error, between rows, by a parabola.
double top_s(const Offsets& offsets, const Eigen::ArrayXd& errors, Eigen::Index row) {
  const double at = offsets.offset_s(static_cast<int>(row));
  if (row == 0 || row + 1 == errors.size()) return at;
  const double a = errors[row - 1], b = errors[row], c = errors[row + 1], bend = a - 2 * b + c;
  return bend > 0 ? at + offsets.bin_s() * std::clamp((a - c) / bend / 2, -1.0, 1.0) : at;
}

}  // namespace

std::optional<ClockStep> find_clock_step(const Trajectory& run, const ClockFit& clock, double wheelbase_m) {
  const Offsets offsets(run, clock, wheelbase_m);
  if (offsets.blocks() < 4) return {};
  const double n = offsets.samples();
  const auto certainty = [&](double worse, double better) {
    constexpr double kLeast = 1e-12;
    return n * std::log(std::max(worse, kLeast) / std::max(better, kLeast));
  };
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double steady = kNone, drifting = kNone, skew = 0;  // errors of one offset, with little and with much drift
  Split split;
  const auto look_at = [&](double tried) {
    const Errors sums = running(offsets.at(tried));
    const double error = sums.rightCols<1>().minCoeff();
    drifting = std::min(drifting, error);
    if (std::abs(tried) > kMostDriftBesideLeap) return;
    steady = std::min(steady, error);
    const Split other = best_split(sums);
    if (other.error < split.error) split = other, skew = tried;
  };
  look_at(0);
  look_at(std::clamp(clock.skew, -kMostDriftBesideLeap, kMostDriftBesideLeap));
  if (certainty(steady, split.error) < kPerhaps) return {};
  const double step = 2 * offsets.bin_s() / offsets.span_s(),
               most = std::max(kMostDrift, 2 * std::abs(clock.skew));
  const int steps = static_cast<int>(most / step);
  for (int i = -steps; i <= steps; ++i) look_at(i * step);
  if (certainty(steady, split.error) < kPerhaps) return {};
  const auto at_limit = [&](Eigen::Index row) { return row == 0 || row + 1 == offsets.offsets(); };
  if (at_limit(split.before) || at_limit(split.after))
    return {};  // the best offset is beyond those that were tried
  const Errors sums = running(offsets.at(skew));
  const Eigen::ArrayXd before = sums.col(split.block), after = sums.rightCols(1) - sums.col(split.block);
  const double by_s = top_s(offsets, after, split.after) - top_s(offsets, before, split.before);
  if (std::abs(by_s) < kSmallestStep_s) return {};
  const double exchanged =
      std::min(before[split.after] - before[split.before], after[split.before] - after[split.after]);
  if (certainty(split.error + exchanged, split.error) < kPerhaps) return {};
  ClockStep found{by_s, offsets.block_begin_s(split.block), offsets.block_begin_s(split.block),
                  certainty(drifting, split.error) > kStepped};
  for (Eigen::Index i = 1; i + 1 < sums.cols(); ++i) {
    const double error = sums(split.before, i) + sums(split.after, sums.cols() - 1) - sums(split.after, i);
    if (certainty(error, split.error) > kMayLie) continue;
    found.begin_s = std::min(found.begin_s, offsets.block_begin_s(static_cast<int>(i) - 1));
    found.end_s = std::max(found.end_s, offsets.block_begin_s(static_cast<int>(i) + 1));
  }
  return found;
}

}  // namespace astro::calibration
