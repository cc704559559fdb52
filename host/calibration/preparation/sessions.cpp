#include "host/calibration/preparation/sessions.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
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
  std::vector<std::size_t> runs;
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

/// Squared standard errors between two mountings; 0 if they are the same within what slip and tyres do.
double distance(const Mounting& a, const Mounting& b) {
  const LeverArm change = difference(a.lever, b.lever);
  const Eigen::Vector3d apart(change.x_m, change.y_m, change.theta_rad);
  if (std::hypot(apart[0], apart[1]) < kSame_m && std::abs(apart[2]) < kSame_rad) return 0;
  const Eigen::Matrix3d covariance = a.covariance + b.covariance;
  return apart.dot(covariance.ldlt().solve(apart));
}

double variance(const std::optional<Mounting>& mounting) {
  return mounting ? mounting->covariance.trace() : std::numeric_limits<double>::infinity();
}

/// The runs with the most precise mountings first, so that each session is known as well as it can be when a run that shows
/// little is compared with it, whatever the order of the runs.
std::vector<std::size_t> most_precise_first(const std::vector<std::optional<Mounting>>& shown) {
  std::vector<std::size_t> order(shown.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return variance(shown[a]) < variance(shown[b]); });
  return order;
}

/// The time between two drives by the tracker's clock; 0 if it began anew for each.
double between_s(const PreparedRun& a, const PreparedRun& b) {
  return std::max(
      {0.0, a.truth.front().time_s - b.truth.back().time_s, b.truth.front().time_s - a.truth.back().time_s});
}

/// How well a run fits a session; the smaller, the better: distance of the mountings, time to the nearest drive, and for
/// takes whose times tell nothing the number of runs and the precision of the mounting.
using Fit = std::array<double, 4>;

Fit fit_of(const Session& session, const PreparedRuns& runs, std::size_t run,
           const std::optional<Mounting>& shown) {
  double nearest_s = std::numeric_limits<double>::infinity();
  for (const std::size_t other : session.runs)
    nearest_s = std::min(nearest_s, between_s(runs.runs[run], runs.runs[other]));
  return {shown && session.mounting ? distance(*shown, *session.mounting) : 0, nearest_s,
          -static_cast<double>(session.runs.size()), variance(session.mounting)};
}

bool may_be_of(const Session& session, const PreparedRuns& runs, std::size_t run) {
  const std::string& name = runs.runs[run].source->session;
  return session.name == name &&
         (!name.empty() || std::abs(session.skew - runs.clocks[run].skew) <= kSameSkew);
}

/// The session to which a run belongs; null if none fits.
Session* session_of(std::vector<Session>& sessions, const PreparedRuns& runs, std::size_t run,
                    const std::optional<Mounting>& shown) {
  Session* best = nullptr;
  Fit least{};
  for (Session& session : sessions) {
    if (!may_be_of(session, runs, run)) continue;
    const Fit fit = fit_of(session, runs, run, shown);
    if ((session.name.empty() && fit[0] > kUnlikely) || (best != nullptr && least <= fit)) continue;
    best = &session;
    least = fit;
  }
  return best;
}

}  // namespace

void find_sessions(PreparedRuns& runs, const WheelFactors& loaded) {
  const std::vector<std::optional<Mounting>> shown = mountings(runs, loaded);
  std::vector<Session> sessions;
  for (const std::size_t i : most_precise_first(shown)) {
    Session* found = session_of(sessions, runs, i, shown[i]);
    if (found == nullptr)
      found =
          &sessions.emplace_back(Session{runs.runs[i].source->session, runs.clocks[i].skew, shown[i], {}});
    found->runs.push_back(i);
  }
  for (Session& session : sessions) std::sort(session.runs.begin(), session.runs.end());
  std::sort(sessions.begin(), sessions.end(),
            [](const Session& a, const Session& b) { return a.runs.front() < b.runs.front(); });
  for (std::size_t number = 0; number < sessions.size(); ++number)
    for (const std::size_t run : sessions[number].runs) runs.runs[run].session = static_cast<int>(number);
}

int session_count(std::span<const PreparedRun> runs) {
  int most = -1;
  for (const PreparedRun& run : runs) most = std::max(most, run.session);
  return most + 1;
}

}  // namespace astro::calibration
