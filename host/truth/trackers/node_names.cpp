#include "host/truth/trackers/node_names.hpp"

#include <algorithm>
#include <optional>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/nodes.hpp"

namespace astro::truth {
namespace {

using ros2::msg::Gid;
using ros2::msg::kGidBytes;
using ros2::msg::kGidBytesOfHumble;
using InfoOfHumble = ros2::msg::ParticipantEntitiesInfo<kGidBytesOfHumble>;
using Info = ros2::msg::ParticipantEntitiesInfo<kGidBytes>;

// Limits of what is kept, because anybody may announce anything. A full name of ROS 2 has 255 characters at
// most.
constexpr std::size_t kMostParticipants = 1024, kMostEndpoints = 32'768, kLongestFullName = 255;

template <std::size_t N>
NodeNames::Guid guid_of(const Gid<N>& gid) {
  NodeNames::Guid guid;
  std::copy_n(gid.data.begin(), guid.size(), guid.begin());
  return guid;
}

/// Nothing if the message is not one of Humble, which pads identifiers with zeros. Later versions have the
/// number of nodes there.
std::optional<InfoOfHumble> info_of_humble(ByteView message) {
  auto info = ros2::decode<InfoOfHumble>(message);
  if (!info) return std::nullopt;
  const auto& gid = info->gid.data;
  const bool padded =
      std::all_of(gid.begin() + kGidBytes, gid.end(), [](std::uint8_t byte) { return byte == 0; });
  return padded ? std::move(info) : std::nullopt;
}

std::string full_name(const std::string& space, const std::string& name) {
  return space.ends_with('/') ? space + name : space + "/" + name;
}

}  // namespace

template <class Info>
void NodeNames::note(const Info& info) {
  const Guid participant = guid_of(info.gid);
  if (nodes_.size() >= kMostParticipants && !nodes_.contains(participant)) return;
  auto& names = nodes_[participant];
  endpoints_ -= names.size();
  names.clear();
  for (const auto& node : info.node_entities_info_seq) {
    const std::string name = full_name(node.node_namespace.text, node.node_name.text);
    if (name.size() > kLongestFullName) continue;
    for (const auto* gids : {&node.writer_gid_seq, &node.reader_gid_seq})
      for (const auto& gid : *gids)
        if (endpoints_ + names.size() < kMostEndpoints) names[guid_of(gid)] = name;
  }
  endpoints_ += names.size();
}

void NodeNames::take(ByteView message) {
  if (const auto humble = info_of_humble(message))
    note(*humble);
  else if (const auto info = ros2::decode<Info>(message))
    note(*info);
}

std::string NodeNames::node_of(const Guid& endpoint) const {
  for (const auto& [participant, names] : nodes_)
    if (const auto found = names.find(endpoint); found != names.end()) return found->second;
  return "";
}

}  // namespace astro::truth
