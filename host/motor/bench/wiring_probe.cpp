#include "host/motor/bench/wiring_probe.hpp"

#include <algorithm>
#include <cstdlib>

namespace astro::motor {
namespace {

using motor::EncoderTrace;

constexpr double kRise_Vps = 2.0, kBeyond_V = 0.5;
constexpr double kAtMost_s = 4.0;    // in total
constexpr double kAtTheTop_s = 0.5;  // at the highest voltage without counts; a stall fault takes longer
constexpr double kAfterwards_s = 0.4;
constexpr long kMoves_counts = 24;

EncoderTrace trace(const std::vector<Moment>& moments, std::size_t begin, std::size_t side) {
  EncoderTrace found;
  const auto counts = [&](std::size_t i) { return static_cast<long>(moments[i].counts[side]); };
  long least = counts(begin), most = counts(begin);
  for (std::size_t i = begin + 1; i < moments.size(); ++i) {
    least = std::min(least, counts(i));
    most = std::max(most, counts(i));
    if (counts(i) != counts(i - 1)) ++found.changes;
  }
  found.counts = counts(moments.size() - 1) - counts(begin);
  found.range = most - least;
  return found;
}

long moved(const Bench& bench, const Moment& from) {
  long most = 0;
  for (std::size_t side = 0; side < 2; ++side)
    most = std::max(most, std::labs(static_cast<long>(bench.now().counts[side] - from.counts[side])));
  return most;
}

}  // namespace

motor::Probe probe_motor(Bench& bench, robot::DriveSession& session, Side motor, double most_V) {
  const Moment start = bench.fresh();
  const std::size_t begin = bench.moments().size() - 1;
  const auto quarter_turn = static_cast<long>(bench.facts().counts_per_turn() / 4);
  const auto apply = [&](double volts) {
    bench.apply(session, motor == Side::left ? volts : 0, motor == Side::right ? volts : 0);
  };
  double volts = 0, top_V = most_V, top_since_s = 0;
  while (bench.now().time_s - start.time_s < kAtMost_s && moved(bench, start) < quarter_turn) {
    if (moved(bench, start) >= kMoves_counts) top_V = std::min(top_V, volts + kBeyond_V);
    if (volts < top_V) top_since_s = bench.now().time_s;
    if (top_V == most_V && bench.now().time_s - top_since_s > kAtTheTop_s) break;
    volts = std::min(top_V, (bench.now().time_s - start.time_s) * kRise_Vps);
    apply(volts);
  }
  for (const double end_s = bench.now().time_s + kAfterwards_s; bench.now().time_s < end_s;) apply(0);
  session.stop();
  return {{trace(bench.moments(), begin, 0), trace(bench.moments(), begin, 1)}, volts, {}};
}

}  // namespace astro::motor
