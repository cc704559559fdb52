#include "host/live/dds/discovery.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "host/base/error.hpp"

namespace astro::dds {
namespace {

Error unknown_value(const std::string& name, const std::string& text, const std::string& known) {
  return Error(name + " is '" + text + "': it has to be " + known, DiscoveryProblem::unknown_value,
               {name, text});
}

int domain_in(const std::string& text) {
  int domain = -1;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (problem != std::errc() || end != text.data() + text.size() || domain < 0 || domain > kMostDomains)
    throw unknown_value("ROS_DOMAIN_ID", text, "a whole number from 0 to " + std::to_string(kMostDomains));
  return domain;
}

std::vector<std::string> peers_in(const std::string& text) {
  std::vector<std::string> peers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    if (end > begin) peers.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return peers;
}

Range range_named(const std::string& text) {
  if (text == "SYSTEM_DEFAULT") return Range::subnet;  // DDS's own default
  const auto range = range_in(text);
  if (!range)
    throw unknown_value("ROS_AUTOMATIC_DISCOVERY_RANGE", text, "OFF, LOCALHOST, SUBNET or SYSTEM_DEFAULT");
  return *range;
}

bool only_localhost(const std::string& text) {
  if (text.empty() || text == "0") return false;
  if (text == "1") return true;
  throw unknown_value("ROS_LOCALHOST_ONLY", text, "0 or 1");
}

}  // namespace

std::optional<Range> range_in(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  if (text == "off") return Range::off;
  if (text == "localhost") return Range::localhost;
  if (text == "subnet") return Range::subnet;
  return std::nullopt;
}

Discovery discovery_from(const DiscoveryWishes& wishes,
                         const std::function<std::string(const char*)>& variable) {
  Discovery discovery;
  if (wishes.domain)
    discovery.domain = *wishes.domain;
  else if (const std::string text = variable("ROS_DOMAIN_ID"); !text.empty())
    discovery.domain = domain_in(text);
  if (const std::string text = variable("ROS_AUTOMATIC_DISCOVERY_RANGE"); !text.empty())
    discovery.range = range_named(text);
  else if (variable("ROS_LOCALHOST_ONLY") == "0")
    discovery.range = Range::subnet;  // somebody asked for it, as in ROS 2 Humble
  const bool only_here = only_localhost(variable("ROS_LOCALHOST_ONLY"));
  if (only_here) discovery.range = Range::localhost;
  discovery.range = wishes.range.value_or(discovery.range);
  const bool peers_count = discovery.range != Range::off && (!only_here || wishes.range);
  if (peers_count) discovery.peers = peers_in(variable("ROS_STATIC_PEERS"));
  return discovery;
}

}  // namespace astro::dds
