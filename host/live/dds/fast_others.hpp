#pragma once

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "host/live/dds/fast_types.hpp"

namespace astro::dds {

/// The endpoints of others, and what they show of themselves. Fast DDS reports them in its own threads.
class Others : public fast::DomainParticipantListener {
 public:
  std::string user_data_of(const Guid& endpoint) const;
  std::vector<RemoteEndpoint> endpoints() const;

 private:
  struct Known {
    RemoteEndpoint endpoint;
    std::string user_data;
  };

  void on_publisher_discovery(fast::DomainParticipant*, rtps::WriterDiscoveryInfo&& found) override;
  void on_subscriber_discovery(fast::DomainParticipant*, rtps::ReaderDiscoveryInfo&& found) override;
  template <class FastInfo>
  void note(const FastInfo& info, bool writes, bool removed);

  mutable std::mutex mutex_;
  std::map<Guid, Known> known_;
};

}  // namespace astro::dds
