#include "host/live/ros2/discovery_info.hpp"

#include <algorithm>
#include <utility>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/cdr/type_hash.hpp"

namespace astro::live {
namespace {

template <std::size_t N>
ros2::msg::Gid<N> gid_of(const dds::Guid& guid) {
  ros2::msg::Gid<N> gid;
  std::copy(guid.bytes.begin(), guid.bytes.end(), gid.data.begin());
  return gid;
}

template <std::size_t N>
std::vector<ros2::msg::Gid<N>> gids_of(const std::vector<dds::Guid>& guids) {
  std::vector<ros2::msg::Gid<N>> gids;
  for (const dds::Guid& guid : guids) gids.push_back(gid_of<N>(guid));
  return gids;
}

template <std::size_t N>
Bytes info_with_gids_of(const dds::Guid& participant, const ros2::NodeName& node,
                        const Endpoints& endpoints) {
  return ros2::encode(ros2::msg::ParticipantEntitiesInfo<N>{
      gid_of<N>(participant),
      {{{node.name_space}, {node.name}, gids_of<N>(endpoints.readers), gids_of<N>(endpoints.writers)}}});
}

// Nodes of Humble show no type hash. The later type's hash does no harm, because matching ignores it.
dds::Topic topic() {
  using Info = ros2::msg::ParticipantEntitiesInfo<ros2::msg::kGidBytes>;
  return {"ros_discovery_info",
          ros2::dds_type_name(Info::kType),
          {.reliable = true, .transient_local = true, .depth = 1},
          "typehash=" + ros2::hash_of<Info>() + ';'};
}

}  // namespace

Bytes discovery_info(const dds::Guid& participant, const ros2::NodeName& node, const Endpoints& endpoints,
                     GidSize gid_size) {
  return gid_size == GidSize::humble
             ? info_with_gids_of<ros2::msg::kGidBytesOfHumble>(participant, node, endpoints)
             : info_with_gids_of<ros2::msg::kGidBytes>(participant, node, endpoints);
}

DiscoveryInfo::DiscoveryInfo(dds::Participant& participant, ros2::NodeName node, GidSize gid_size)
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

}  // namespace astro::live
