#include "host/truth/trackers/vrpn_directory.hpp"

#include <algorithm>

namespace astro::truth::vrpn {
namespace {

constexpr std::size_t kMostNames = 2000;

bool is_the_librarys(std::string_view name) {
  return name == "VRPN Control" || name.starts_with("vrpn_Forwarder") || name.empty();
}

}  // namespace

bool Directory::take(const Message& message) {
  const bool sender = message.type == kSenderDescription;
  if (!sender && message.type != kTypeDescription) return false;
  Names& names = sender ? senders_ : types_;
  const auto name = name_in(message.payload);
  if (name && (names.size() < kMostNames || names.contains(message.sender))) names[message.sender] = *name;
  return true;
}

std::string_view Directory::name_of(const Names& names, std::int32_t id) {
  const auto found = names.find(id);
  return found == names.end() ? std::string_view() : std::string_view(found->second);
}

std::vector<std::string> Directory::bodies() const {
  std::vector<std::string> bodies;
  for (const auto& [id, name] : senders_)
    if (!is_the_librarys(name)) bodies.push_back(name);
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return bodies;
}

}  // namespace astro::truth::vrpn
