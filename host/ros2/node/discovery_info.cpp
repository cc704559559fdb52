#include "host/ros2/node/discovery_info.hpp"

#include <algorithm>
#include <utility>

#include "host/ros2/cdr/codec.hpp"
#include "host/ros2/types/type_description.hpp"

namespace astro::ros2 {
namespace {

template <std::size_t N>
msg::Gid<N> gid_of(const dds::Guid& guid) {
  msg::Gid<N> gid;
  std::copy(guid.bytes.begin(), guid.bytes.end(), gid.data.begin());
  return gid;
}

template <std::size_t N>
std::vector<msg::Gid<N>> gids_of(const std::vector<dds::Guid>& guids) {
  std::vector<msg::Gid<N>> gids;
  for (const dds::Guid& guid : guids) gids.push_back(gid_of<N>(guid));
  return gids;
}

template <std::size_t N>
Bytes info_with_gids_of(const dds::Guid& participant, const NodeName& node, const Endpoints& endpoints) {
  return encode(msg::ParticipantEntitiesInfo<N>{
      gid_of<N>(participant),
      {{{node.name_space}, {node.name}, gids_of<N>(endpoints.readers), gids_of<N>(endpoints.writers)}}});
}

// Those of Humble show no hash; that of the later type does no harm, because matching ignores it.
dds::Topic topic() {
  using Info = msg::ParticipantEntitiesInfo<msg::kGidBytes>;
  return {"ros_discovery_info",
          dds_type_name(Info::kType),
          {.reliable = true, .transient_local = true, .depth = 1},
          "typehash=" + hash_of<Info>() + ';'};
}

}  // namespace

Bytes discovery_info(const dds::Guid& participant, const NodeName& node, const Endpoints& endpoints,
                     GidSize gid_size) {
  return gid_size == GidSize::humble ? info_with_gids_of<msg::kGidBytesOfHumble>(participant, node, endpoints)
                                     : info_with_gids_of<msg::kGidBytes>(participant, node, endpoints);
}

DiscoveryInfo::DiscoveryInfo(dds::Participant& participant, NodeName node, GidSize gid_size)
    : participant_(participant.guid()),
      node_(std::move(node)),
      gid_size_(gid_size),
      writer_(participant.create_writer(topic())) {}

void DiscoveryInfo::add_reader(const dds::Guid& reader) {
  endpoints_.readers.push_back(reader);
  changed_ = true;
}

void DiscoveryInfo::add_writer(const dds::Guid& writer) {
  endpoints_.writers.push_back(writer);
  changed_ = true;
}

void DiscoveryInfo::remove_writer(const dds::Guid& writer) {
  std::erase(endpoints_.writers, writer);
  changed_ = true;
}

void DiscoveryInfo::publish_changes() {
  if (!changed_) return;
  writer_->write(discovery_info(participant_, node_, endpoints_, gid_size_));
  changed_ = false;
}

}  // namespace astro::ros2
