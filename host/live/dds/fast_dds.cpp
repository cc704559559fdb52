#include "host/live/dds/fast_dds.hpp"

#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <list>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/live/dds/fast_endpoints.hpp"
#include "host/live/dds/fast_others.hpp"
#include "host/live/dds/fast_transport.hpp"
#include "host/live/dds/fast_types.hpp"

namespace astro::dds {
namespace {

// With the default of 3 s every other start finds its peers only after 2 s.
constexpr double kAnnouncementPeriod_s = 0.2;
// At first announcements are more frequent, because others answer the first one that they receive.
constexpr std::uint32_t kFirstAnnouncements = 10;
constexpr double kFirstAnnouncementPeriod_s = 0.01;
// How long others keep a participant that has died; the default is 20 s.
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
    if (addresses.empty())
      throw Error("ROS_STATIC_PEERS names '" + peer + "', which has no IPv4 address",
                  DiscoveryProblem::peer_without_address, {peer});
    for (const std::string& address : addresses) locators.push_back(locator_of(address, 0));
  }
  return locators;
}

/// Lists the addresses where we can be reached; a list that is not empty replaces multicast. Loopback is added to "all
/// interfaces", which does not include it, because a peer that uses only loopback does not send to the addresses of
/// interfaces.
void listen_without_multicast(fast::WireProtocolConfigQos& wire) {
  for (const rtps::Locator_t& locator : {rtps::Locator_t(), locator_of(kLoopback, 0)}) {
    wire.builtin.metatrafficUnicastLocatorList.push_back(locator);
    wire.default_unicast_locator_list.push_back(locator);
  }
}

/// The addresses where others are looked for. If the list is not empty, multicast has to be in it, too.
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

/// The lowest number that no other participant of this process has. Those who look for others without multicast look at the ports of
/// low numbers alone, and by itself Fast DDS numbers on and on, however many participants have gone.
class ParticipantNumber {
 public:
  ParticipantNumber() {
    const std::lock_guard lock(mutex());
    while (!taken().insert(number_).second) ++number_;
  }
  ~ParticipantNumber() {
    const std::lock_guard lock(mutex());
    taken().erase(number_);
  }
  ParticipantNumber(const ParticipantNumber&) = delete;
  ParticipantNumber& operator=(const ParticipantNumber&) = delete;

  std::int32_t value() const { return number_; }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  static std::set<std::int32_t>& taken() {
    static std::set<std::int32_t> numbers;
    return numbers;
  }

  std::int32_t number_ = 1;
};

/// As Fast DDS makes them, but for the last part, which it takes from the number: nobody may take a participant for one of the same
/// number that has gone.
rtps::GuidPrefix_t new_guid_prefix() {
  static const std::array<std::uint32_t, 2> process{std::random_device()(), std::random_device()()};
  static std::atomic<std::uint32_t> count = 0;
  const std::uint32_t own = ++count;
  rtps::GuidPrefix_t prefix;
  std::memcpy(prefix.value, process.data(), sizeof process);
  std::memcpy(prefix.value + sizeof process, &own, sizeof own);
  prefix.value[0] = rtps::c_VendorId_eProsima[0];
  prefix.value[1] = rtps::c_VendorId_eProsima[1];
  return prefix;
}

/// How a participant of this name looks for others, and where it can be reached. It sends nothing before the gate opens.
/// Throws astro::Error naming a static peer that has no address.
fast::DomainParticipantQos participant_settings(const Discovery& discovery, const std::string& name,
                                                std::shared_ptr<const Gate> gate,
                                                std::shared_ptr<AcknowledgedBy> acknowledged) {
  fast::DomainParticipantQos qos;
  qos.name(name.c_str());
  const bool here_alone = discovery.range != Range::subnet && discovery.peers.empty();
  // The built-in transports include shared memory, which would leave files behind when a program dies.
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

constexpr std::ptrdiff_t kGuidPrefixBytes = 12;  // the same for all endpoints of a participant

/// A participant of Fast DDS, which has one type for each topic.
class OneParticipant {
 public:
  OneParticipant(const Discovery& discovery, const std::string& name, const std::string& user_data,
                 Others& others) {
    const auto gate = std::make_shared<Gate>();
    fast::DomainParticipantQos qos = participant_settings(discovery, name, gate, acknowledged_);
    qos.user_data().data_vec(octets(user_data));
    qos.wire_protocol().participant_id = number_.value();
    qos.wire_protocol().prefix = new_guid_prefix();
    participant_ = fast::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(discovery.domain), qos, &others, fast::StatusMask::none());
    if (participant_ == nullptr)
      throw Error("DDS makes no participant in domain " + std::to_string(discovery.domain));
    gate->open();
    publisher_ = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  }
  ~OneParticipant() {
    participant_->set_listener(nullptr);
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  OneParticipant(const OneParticipant&) = delete;
  OneParticipant& operator=(const OneParticipant&) = delete;

  bool takes(const Topic& topic) const {
    const auto found = topics_.find(topic.name);
    return found == topics_.end() || found->second->get_type_name() == topic.type;
  }
  fast::Topic* topic(const Topic& wanted) {
    fast::Topic*& topic = topics_[wanted.name];
    if (topic == nullptr) {
      fast::TypeSupport(new OpaqueType(wanted.type)).register_type(participant_);  // owns it
      topic = participant_->create_topic(wanted.name, wanted.type, fast::TOPIC_QOS_DEFAULT);
    }
    if (topic == nullptr) throw Error("DDS refuses the topic " + wanted.name);
    return topic;
  }
  Guid guid() const { return to_guid(participant_->guid()); }
  AcknowledgedBy& acknowledged() { return *acknowledged_; }
  fast::Publisher& publisher() { return *publisher_; }
  fast::Subscriber& subscriber() { return *subscriber_; }

 private:
  ParticipantNumber number_;
  std::shared_ptr<AcknowledgedBy> acknowledged_ = std::make_shared<AcknowledgedBy>();
  fast::DomainParticipant* participant_;
  fast::Publisher* publisher_;
  fast::Subscriber* subscriber_;
  std::map<std::string, fast::Topic*> topics_;
};

class FastParticipant : public Participant {
 public:
  FastParticipant(const Discovery& discovery, std::string name, std::string user_data)
      : discovery_(discovery), name_(std::move(name)), user_data_(std::move(user_data)) {
    add();
  }

  std::unique_ptr<Writer> create_writer(const Topic& topic) override {
    OneParticipant& one = for_topic(topic);
    return std::make_unique<FastWriter>(one.publisher(), one.topic(topic), topic, one.acknowledged());
  }
  std::unique_ptr<Reader> create_reader(const Topic& topic) override {
    OneParticipant& one = for_topic(topic);
    return std::make_unique<FastReader>(one.subscriber(), one.topic(topic), topic, bell_);
  }
  Guid guid() const override { return guid_; }
  std::vector<RemoteEndpoint> remote_endpoints() const override {
    std::vector<RemoteEndpoint> all = others_.endpoints();
    std::erase_if(all, [&](const RemoteEndpoint& at) { return is_own(at.guid); });
    return all;
  }
  std::string user_data_of(const Guid& endpoint) const override { return others_.user_data_of(endpoint); }
  void wait(std::chrono::microseconds timeout) override { bell_.wait(timeout); }

 private:
  OneParticipant& add() {
    participants_.emplace_back(discovery_, name_, user_data_, others_);
    if (participants_.size() == 1) guid_ = participants_.front().guid();
    return participants_.back();
  }
  /// Whether an endpoint is ours: several participants of ours also find one another.
  bool is_own(const Guid& endpoint) const {
    return std::ranges::any_of(participants_, [&](const OneParticipant& one) {
      return std::equal(endpoint.bytes.begin(), endpoint.bytes.begin() + kGuidPrefixBytes,
                        one.guid().bytes.begin());
    });
  }
  OneParticipant& for_topic(const Topic& topic) {
    const auto found = std::find_if(participants_.begin(), participants_.end(),
                                    [&](const OneParticipant& one) { return one.takes(topic); });
    return found == participants_.end() ? add() : *found;
  }

  Discovery discovery_;
  std::string name_, user_data_;
  Others others_;
  Bell bell_;
  std::list<OneParticipant> participants_;
  Guid guid_;
};

/// Fast DDS prints to standard output by default, where only the program's own output belongs.
void log_to_standard_error() {
  fast::Log::ClearConsumers();
  fast::Log::RegisterConsumer(std::make_unique<fast::StdoutErrConsumer>());
}

}  // namespace

std::unique_ptr<Participant> open_fast_dds(const Discovery& discovery, const std::string& name,
                                           const std::string& user_data) {
  log_to_standard_error();
  return std::make_unique<FastParticipant>(discovery, name, user_data);
}

}  // namespace astro::dds
