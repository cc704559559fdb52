#include "host/calibration/preparation/sessions.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/calibration/preparation/mounting.hpp"

namespace astro::calibration {
namespace {

// Slip and the tyres in spins shift the estimated mounting of the same body a little from drive to drive. Two mountings differ
// if their position or their yaw differs by at least these limits, and by far more than noise explains.
constexpr double kSame_m = 0.01, kSame_rad = 0.02;
constexpr double kUnlikely = 25;  // squared standard errors, of all three together
// The clock search finds the skew of a run of half a minute to half of this.
constexpr double kSameSkew = 0.012;

/// What is known of a session so far.
struct Session {
  std::string name;
  double skew = 0;
  std::optional<Mounting> mounting;
};

std::vector<std::optional<Mounting>> mountings(const PreparedRuns& runs, const WheelFactors& loaded) {
  std::vector<std::vector<RelativePose>> pieces;
  std::vector<RelativePose> all;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    pieces.emplace_back();
    if (!runs.runs[i].has_headings) continue;
    pieces.back() = pieces_of(runs.runs[i], runs.clocks[i], loaded.b_m);
    all.insert(all.end(), pieces.back().begin(), pieces.back().end());
  }
  const std::optional<TurnRates> rates = fit_headings(all);
  std::vector<std::optional<Mounting>> found(runs.runs.size());
  if (rates)
    for (std::size_t i = 0; i < found.size(); ++i)
      if (!pieces[i].empty()) found[i] = mounting_of(pieces[i], *rates);
  return found;
}

bool differ(const Mounting& a, const Mounting& b) {
  const LeverArm change = difference(a.lever, b.lever);
  const Eigen::Vector3d apart(change.x_m, change.y_m, change.theta_rad);
  if (std::hypot(apart[0], apart[1]) < kSame_m && std::abs(apart[2]) < kSame_rad) return false;
  const Eigen::Matrix3d covariance = a.covariance + b.covariance;
  return apart.dot(covariance.ldlt().solve(apart)) > kUnlikely;
}

/// Keeps the more precise one of two mountings that do not differ.
void learn(std::optional<Mounting>& known, const std::optional<Mounting>& run) {
  if (run && (!known || run->covariance.trace() < known->covariance.trace())) known = run;
}

}  // namespace

void find_sessions(PreparedRuns& runs, const WheelFactors& loaded) {
  const std::vector<std::optional<Mounting>> shown = mountings(runs, loaded);
  std::vector<Session> sessions;
  int last = 0;
  for (std::size_t i = 0; i < runs.runs.size(); ++i) {
    const std::string& name = runs.runs[i].source->session;
    const auto holds = [&](const Session& session) {
      if (session.name != name) return false;
      if (name.empty() && std::abs(session.skew - runs.clocks[i].skew) > kSameSkew) return false;
      return !name.empty() || !shown[i] || !session.mounting || !differ(*shown[i], *session.mounting);
    };
    auto found = sessions.begin() + (sessions.empty() ? 0 : last);
    if (sessions.empty() || !holds(*found)) found = std::find_if(sessions.begin(), sessions.end(), holds);
    if (found == sessions.end())
      found = sessions.insert(sessions.end(), Session{name, runs.clocks[i].skew, {}});
    learn(found->mounting, shown[i]);
    runs.runs[i].session = last = static_cast<int>(found - sessions.begin());
  }
}

int session_count(std::span<const PreparedRun> runs) {
  int most = -1;
  for (const PreparedRun& run : runs) most = std::max(most, run.session);
  return most + 1;
}

}  // namespace astro::calibration
