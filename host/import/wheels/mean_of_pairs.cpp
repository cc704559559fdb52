#include "host/import/wheels/mean_of_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/side.hpp"

namespace astro::importing {
namespace {

double way_of(const Wheels& wheels, double WheelSample::*wheel) {
  double way = 0;
  for (std::size_t i = 1; i < wheels.size(); ++i) way += std::abs(wheels[i].*wheel - wheels[i - 1].*wheel);
  return way;
}

std::string joined_names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& one : names) text += (text.empty() ? "" : " and ") + one;
  return text;
}

}  // namespace

Wheels mean_of_pairs(std::vector<Wheels> pairs, const std::vector<std::string>& left,
                     const std::vector<std::string>& right, std::vector<Remark>& remarks) {
  if (pairs.size() == 1) return std::move(pairs.front());
  std::size_t common = pairs.front().size();
  for (const Wheels& pair : pairs) common = std::min(common, pair.size());
  for (Wheels& pair : pairs) pair.erase(pair.begin(), pair.end() - static_cast<std::ptrdiff_t>(common));
  Wheels means = pairs.front();
  for (const Side side : kSides) {
    double WheelSample::*const wheel = side == Side::left ? &WheelSample::left : &WheelSample::right;
    std::vector<double> ways;
    for (const Wheels& pair : pairs) ways.push_back(way_of(pair, wheel));
    for (std::size_t k = 0; k < common; ++k) {
      means[k].*wheel = 0;
      for (const Wheels& pair : pairs) means[k].*wheel += pair[k].*wheel / static_cast<double>(pairs.size());
    }
    const auto [least, most] = std::ranges::minmax(ways);
    const std::string percent = fmt::format("{:.2g}", most > 0 ? 100 * (most - least) / most : 0);
    remarks.push_back({fmt::format("the {} wheel is the mean of {}, whose ways differ by {} %", name(side),
                                   joined_names(side == Side::left ? left : right), percent),
                       WheelRemark::sides_differ,
                       {name(side), percent}});
  }
  return means;
}

}  // namespace astro::importing
