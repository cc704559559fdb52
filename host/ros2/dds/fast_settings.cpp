#include "host/ros2/dds/fast_settings.hpp"

#include <fastrtps/utils/IPLocator.h>

#include <set>
#include <utility>
#include <vector>

#include "host/base/error.hpp"

namespace astro::ros2::dds {
namespace {

// With the default of 3 s every other start finds its peers only after 2 s.
constexpr double kAnnouncementPeriod_s = 0.2;
// At first more often: others answer the first one that they get.
constexpr std::uint32_t kFirstAnnouncements = 10;
constexpr double kFirstAnnouncementPeriod_s = 0.01;
// How long others keep one that has died; the default is 20 s.
constexpr double kLease_s = 5;
constexpr std::uint32_t kMulticastPort = 7400, kPortsPerDomain = 250;
constexpr const char* kMulticastAddress = "239.255.0.1";  // these three are DDSI-RTPS's defaults
constexpr const char* kLoopback = "127.0.0.1";

rtps::Locator_t locator_of(const std::string& address, std::uint32_t port) {
  rtps::Locator_t locator;  // UDP over IPv4
  rtps::IPLocator::setIPv4(locator, address);
  locator.port = port;
  return locator;
}

std::vector<rtps::Locator_t> locators_of_peers(const std::vector<std::string>& peers) {
  std::vector<rtps::Locator_t> locators;
  for (const std::string& peer : peers) {
    const std::set<std::string> addresses = rtps::IPLocator::isIPv4(peer)
                                                ? std::set<std::string>{peer}
                                                : rtps::IPLocator::resolveNameDNS(peer).first;
    if (addresses.empty()) throw Error("ROS_STATIC_PEERS names '" + peer + "', which has no IPv4 address");
    for (const std::string& address : addresses) locators.push_back(locator_of(address, 0));
  }
  return locators;
}

/// Where we can be reached without multicast, which a list that is not empty replaces. Loopback besides all interfaces, of which
/// it is none: a peer that keeps to it does not send to the addresses of others.
void listen_without_multicast(fast::WireProtocolConfigQos& wire) {
  for (const rtps::Locator_t& locator : {rtps::Locator_t(), locator_of(kLoopback, 0)}) {
    wire.builtin.metatrafficUnicastLocatorList.push_back(locator);
    wire.default_unicast_locator_list.push_back(locator);
  }
}

/// Where others are looked for. Multicast has to be named if anything is.
rtps::LocatorList_t places_of(const Discovery& discovery) {
  rtps::LocatorList_t places;
  if (discovery.range == Range::localhost) places.push_back(locator_of(kLoopback, 0));
  for (const rtps::Locator_t& peer : locators_of_peers(discovery.peers)) places.push_back(peer);
  if (discovery.range == Range::subnet && !discovery.peers.empty())
    places.push_back(locator_of(
        kMulticastAddress, kMulticastPort + kPortsPerDomain * static_cast<std::uint32_t>(discovery.domain)));
  return places;
}

void set_times(rtps::DiscoverySettings& settings) {
  settings.leaseDuration = eprosima::fastrtps::Duration_t(kLease_s);
  settings.leaseDuration_announcementperiod = eprosima::fastrtps::Duration_t(kAnnouncementPeriod_s);
  settings.initial_announcements = {kFirstAnnouncements,
                                    eprosima::fastrtps::Duration_t(kFirstAnnouncementPeriod_s)};
}

}  // namespace

fast::DomainParticipantQos participant_settings(const Discovery& discovery, const std::string& name,
                                                std::shared_ptr<const Gate> gate,
                                                std::shared_ptr<AcknowledgedBy> acknowledged) {
  fast::DomainParticipantQos qos;
  qos.name(name.c_str());
  const bool here_alone = discovery.range != Range::subnet && discovery.peers.empty();
  // The transports that are built in have shared memory, which would leave files behind when a program dies.
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(gated_udp(here_alone, std::move(gate), std::move(acknowledged)));
  rtps::BuiltinAttributes& builtin = qos.wire_protocol().builtin;
  set_times(builtin.discovery_config);
  if (discovery.range == Range::off)
    builtin.discovery_config.discoveryProtocol = rtps::DiscoveryProtocol_t::NONE;
  if (discovery.range != Range::subnet) listen_without_multicast(qos.wire_protocol());
  builtin.initialPeersList = places_of(discovery);
  return qos;
}

}  // namespace astro::ros2::dds
