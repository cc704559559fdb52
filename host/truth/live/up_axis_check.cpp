#include "host/truth/live/up_axis_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace astro::truth {
namespace {

constexpr double kRise_m = 0.3, kStill_m = 0.03;
constexpr int kEnough = 20;  // a marker that is taken for another one is so for a few frames

}  // namespace

void UpAxisCheck::take(const Pose3& pose) {
  if (!first_) first_ = pose;
  const double y_m = pose.y_m - first_->y_m, z_m = pose.z_m - first_->z_m;
  const double up_m = assumed_ == UpAxis::y ? y_m : z_m, other_m = assumed_ == UpAxis::y ? z_m : y_m;
  least_m_ = std::min(least_m_, other_m);
  most_m_ = std::max(most_m_, other_m);
  const bool contradicts = std::abs(up_m) > kRise_m && most_m_ - least_m_ < kStill_m;
  contradictions_ = contradicts ? std::min(contradictions_ + 1, kEnough) : 0;
  risen_m_ = up_m;
}

void UpAxisCheck::forget() { *this = UpAxisCheck(assumed_); }

std::optional<Remark> UpAxisCheck::objection() const {
  if (contradictions_ < kEnough) return std::nullopt;
  const bool y_assumed = assumed_ == UpAxis::y;
  const std::string up = y_assumed ? "y" : "z", other = y_assumed ? "z" : "y";
  return Remark{
      fmt::format("the body {} by {:.2f} m along the tracker's {} axis, which is taken for up, and keeps "
                  "its place along {}: if that one points up, put up={} behind the ? of the tracker's "
                  "address",
                  risen_m_ > 0 ? "rises" : "falls", std::abs(risen_m_), up, other, other),
      UpAxisProblem::contradicted,
      {up, other, fmt::format("{:.2f}", risen_m_)}};
}

}  // namespace astro::truth
