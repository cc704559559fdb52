#include "tests/support/film/picture/blur.hpp"

#include <cmath>

namespace astro::support::film {
namespace {

std::vector<float> weights_of(double sigma_px) {
  const int reach = blur_reach_px(sigma_px);
  std::vector<double> weights;
  double sum = 0;
  for (int at = -reach; at <= reach; ++at) {
    weights.push_back(sigma_px > 0 ? std::exp(-0.5 * at * at / (sigma_px * sigma_px)) : 1);
    sum += weights.back();
  }
  std::vector<float> normalised;
  for (const double weight : weights) normalised.push_back(static_cast<float>(weight / sum));
  return normalised;
}

}  // namespace

int blur_reach_px(double sigma_px) { return static_cast<int>(std::ceil(3.5 * sigma_px)); }

Plane blurred(const Plane& sharp, const Window& window, double sigma_px) {
  const int reach = blur_reach_px(sigma_px);
  const std::vector<float> weights = weights_of(sigma_px);
  const Window& given = sharp.window();
  const int width = window.width();
  // Down the columns first, a whole row at a time; then along the rows.
  Plane result(window);
  std::vector<float> column_sum(static_cast<std::size_t>(width + 2 * reach));
  for (int v = window.top; v < window.bottom; ++v) {
    std::fill(column_sum.begin(), column_sum.end(), 0.0F);
    const int from = std::max(window.left - reach, given.left),
              to = std::min(window.right + reach, given.right);
    float* const sum = column_sum.data() + (from - (window.left - reach));
    for (int tap = -reach; tap <= reach; ++tap) {
      const float* const row = sharp.row(std::clamp(v + tap, given.top, given.bottom - 1)) + from;
      const float weight = weights[static_cast<std::size_t>(tap + reach)];
      for (int u = 0; u < to - from; ++u) sum[u] += weight * row[u];
    }
    for (float* before = sum - 1; before >= column_sum.data(); --before) *before = sum[0];
    for (float* after = sum + (to - from); after < column_sum.data() + column_sum.size(); ++after)
      *after = sum[to - from - 1];
    float* const out = result.row(v) + window.left;
    std::fill(out, out + width, 0.0F);
    for (int tap = 0; tap <= 2 * reach; ++tap) {
      const float weight = weights[static_cast<std::size_t>(tap)];
      const float* const in = column_sum.data() + tap;
      for (int u = 0; u < width; ++u) out[u] += weight * in[u];
    }
  }
  return result;
}

}  // namespace astro::support::film
