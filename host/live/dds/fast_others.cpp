#include "host/live/dds/fast_others.hpp"

namespace astro::dds {

namespace {

constexpr std::size_t kLongestUserData = 1024;  // of an endpoint; those of ROS 2 take some 200 bytes

}  // namespace

std::string Others::user_data_of(const Guid& endpoint) const {
  const std::lock_guard lock(mutex_);
  const auto found = known_.find(endpoint);
  return found == known_.end() ? "" : found->second.user_data;
}

std::vector<RemoteEndpoint> Others::endpoints() const {
  const std::lock_guard lock(mutex_);
  std::vector<RemoteEndpoint> all;
  for (const auto& [guid, known] : known_) all.push_back(known.endpoint);
  return all;
}

void Others::on_publisher_discovery(fast::DomainParticipant*, rtps::WriterDiscoveryInfo&& found) {
  note(found.info, true, found.status == found.REMOVED_WRITER);
}

void Others::on_subscriber_discovery(fast::DomainParticipant*, rtps::ReaderDiscoveryInfo&& found) {
  note(found.info, false, found.status == found.REMOVED_READER);
}

template <class FastInfo>
void Others::note(const FastInfo& info, bool writes, bool removed) {
  const Guid guid = to_guid(info.guid());
  const auto& data = info.m_qos.m_userData.getValue();
  const std::lock_guard lock(mutex_);
  if (removed)
    known_.erase(guid);
  else
    known_[guid] = {{guid, writes, info.topicName().to_string(), info.typeName().to_string()},
                    data.size() <= kLongestUserData ? std::string(data.begin(), data.end()) : ""};
}

}  // namespace astro::dds
