#include "host/truth/files/body_choice.hpp"

#include <algorithm>

namespace astro::truth {
namespace {

constexpr std::size_t kMostBodiesShown = 20;

std::string listed(const std::vector<BodyName>& bodies) {
  std::string out;
  for (std::size_t i = 0; i < std::min(bodies.size(), kMostBodiesShown); ++i) {
    out += (i > 0 ? ", '" : "'") + bodies[i].name.substr(0, 80) + "'";
    const auto same = [&](const BodyName& other) { return other.name == bodies[i].name; };
    if (std::count_if(bodies.begin(), bodies.end(), same) > 1)
      out += " (id " + bodies[i].id.substr(0, 40) + ")";
  }
  return out + (bodies.size() > kMostBodiesShown ? ", ..." : "");
}

}  // namespace

std::size_t choose_body(const std::vector<BodyName>& bodies, std::string_view wanted, std::string_view file) {
  if (wanted.empty() && bodies.size() == 1) return 0;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const bool by_id = !wanted.empty() && bodies[i].id == wanted;
    if (bodies[i].name == wanted || by_id) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  if (wanted.empty())
    throw UnknownBody("'" + std::string(file) + "' holds several bodies: " + listed(bodies), file, wanted,
                      bodies);
  const std::string how = found.empty() ? "no body" : "several bodies";
  throw UnknownBody("'" + std::string(file) + "' holds " + how + " of the name '" + std::string(wanted) +
                        "', but " + listed(bodies),
                    file, wanted, bodies);
}

}  // namespace astro::truth
