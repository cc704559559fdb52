#include "host/ros2/dds/fast_dds.hpp"

#include <fastdds/rtps/common/WriteParams.h>
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <algorithm>
#include <condition_variable>
#include <list>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "host/base/error.hpp"
#include "host/ros2/dds/fast_transport.hpp"

namespace astro::ros2::dds {
namespace {

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr std::uint32_t kFirstAllocation = 1024;  // grows with larger samples
constexpr std::uint32_t kLargestSample = 1 << 20;
constexpr std::ptrdiff_t kGuidPrefixBytes = 12;  // the same for all endpoints of a participant
constexpr std::size_t kLongestUserData = 1024;   // of an endpoint; those of ROS 2 take some 200 bytes
constexpr std::uint32_t kParticipants = 32;      // of one computer, that are looked for without multicast
// With the default of 3 s every other start finds its peers only after 2 s.
constexpr double kAnnouncementPeriod_s = 0.5;
// At first more often: others answer the first one that they get.
constexpr std::uint32_t kFirstAnnouncements = 10;
constexpr double kFirstAnnouncementPeriod_s = 0.05;
// A sample that a reader missed, because it had not yet found the writer, comes again after this time; the default is 3 s.
constexpr double kHeartbeatPeriod_s = 0.1;
constexpr std::uint32_t kMulticastPort = 7400, kPortsPerDomain = 250;
constexpr const char* kMulticastAddress = "239.255.0.1";  // these three are DDSI-RTPS's defaults
constexpr const char* kLoopback = "127.0.0.1";

Guid to_guid(const rtps::GUID_t& from) {
  Guid guid;
  std::copy_n(from.guidPrefix.value, 12, guid.bytes.begin());
  std::copy_n(from.entityId.value, 4, guid.bytes.begin() + 12);
  return guid;
}

rtps::GUID_t from_guid(const Guid& from) {
  rtps::GUID_t guid;
  std::copy_n(from.bytes.begin(), 12, guid.guidPrefix.value);
  std::copy_n(from.bytes.begin() + 12, 4, guid.entityId.value);
  return guid;
}

Guid to_guid(const fast::InstanceHandle_t& handle) {
  rtps::GUID_t guid;
  rtps::iHandle2GUID(guid, handle);
  return to_guid(guid);
}

SampleId to_sample_id(const rtps::SampleIdentity& from) {
  return {to_guid(from.writer_guid()), static_cast<std::int64_t>(from.sequence_number().to64long())};
}

rtps::SampleIdentity from_sample_id(const SampleId& from) {
  rtps::SampleIdentity identity;
  identity.writer_guid(from_guid(from.writer));
  identity.sequence_number(rtps::SequenceNumber_t(static_cast<std::int32_t>(from.number >> 32),
                                                  static_cast<std::uint32_t>(from.number)));
  return identity;
}

/// What Fast DDS hands through: bytes on their way out or in.
struct Payload {
  ByteView out;
  Bytes in;
};

/// A type of which Fast DDS knows the name alone. Without type information, because newer versions compare it.
class OpaqueType : public fast::TopicDataType {
 public:
  explicit OpaqueType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = kFirstAllocation;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* into) override {
    const ByteView bytes = static_cast<Payload*>(data)->out;
    if (bytes.size() > into->max_size) return false;
    std::copy(bytes.begin(), bytes.end(), into->data);
    into->length = static_cast<std::uint32_t>(bytes.size());
    into->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* from, void* data) override {
    if (from->length > kLargestSample) return false;
    static_cast<Payload*>(data)->in.assign(from->data, from->data + from->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [size = static_cast<std::uint32_t>(static_cast<Payload*>(data)->out.size())] { return size; };
  }
  void* createData() override { return new Payload; }  // Fast DDS owns it
  void deleteData(void* data) override { delete static_cast<Payload*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

std::vector<rtps::octet> octets(const std::string& text) { return {text.begin(), text.end()}; }

template <class FastQos>
FastQos with(FastQos qos, const Topic& topic) {
  qos.reliability().kind =
      topic.qos.reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      topic.qos.transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
  qos.history().kind = topic.qos.depth > 0 ? fast::KEEP_LAST_HISTORY_QOS : fast::KEEP_ALL_HISTORY_QOS;
  if (topic.qos.depth > 0) qos.history().depth = topic.qos.depth;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  qos.user_data().data_vec(octets(topic.user_data));
  return qos;
}

/// Endpoints that have found one of ours. Fast DDS reports them in its own threads.
class Matched {
 public:
  void note(const fast::InstanceHandle_t& handle, int change) {
    const std::lock_guard lock(mutex_);
    if (change > 0)
      guids_.insert(to_guid(handle));
    else
      guids_.erase(to_guid(handle));
  }
  std::vector<Guid> all() const {
    const std::lock_guard lock(mutex_);
    return {guids_.begin(), guids_.end()};
  }

 private:
  mutable std::mutex mutex_;
  std::set<Guid> guids_;
};

/// Lets the one thread that uses a participant sleep until something has come.
class Bell {
 public:
  void ring() {
    {
      const std::lock_guard lock(mutex_);
      rung_ = true;
    }
    condition_.notify_one();
  }
  void wait(std::chrono::microseconds timeout) {
    std::unique_lock lock(mutex_);
    condition_.wait_for(lock, timeout, [&] { return rung_; });
    rung_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  bool rung_ = false;
};

class FastWriter : public Writer, fast::DataWriterListener {
 public:
  FastWriter(fast::Publisher& publisher, fast::Topic* topic, const Topic& wanted) : publisher_(publisher) {
    fast::DataWriterQos qos = with(fast::DATAWRITER_QOS_DEFAULT, wanted);
    qos.publish_mode().kind = fast::SYNCHRONOUS_PUBLISH_MODE;
    qos.reliable_writer_qos().times.heartbeatPeriod = eprosima::fastrtps::Duration_t(kHeartbeatPeriod_s);
    qos.writer_data_lifecycle().autodispose_unregistered_instances = false;
    writer_ = publisher_.create_datawriter(topic, qos, this, fast::StatusMask::publication_matched());
    if (writer_ == nullptr) throw Error("DDS makes no writer of the topic " + wanted.name);
  }
  ~FastWriter() override {
    writer_->set_listener(nullptr);
    publisher_.delete_datawriter(writer_);
  }
  FastWriter(const FastWriter&) = delete;
  FastWriter& operator=(const FastWriter&) = delete;

  Guid guid() const override { return to_guid(writer_->guid()); }
  std::vector<Guid> readers() const override { return readers_.all(); }

 private:
  void send(ByteView payload, const SampleId* related) override {
    Payload sample{payload, {}};
    rtps::WriteParams parameters;
    if (related != nullptr) parameters.related_sample_identity(from_sample_id(*related));
    writer_->write(&sample, parameters);
  }
  void on_publication_matched(fast::DataWriter*, const fast::PublicationMatchedStatus& status) override {
    readers_.note(status.last_subscription_handle, status.current_count_change);
  }

  fast::Publisher& publisher_;
  fast::DataWriter* writer_;
  Matched readers_;
};

class FastReader : public Reader, fast::DataReaderListener {
 public:
  FastReader(fast::Subscriber& subscriber, fast::Topic* topic, const Topic& wanted, Bell& bell)
      : subscriber_(subscriber), bell_(bell) {
    fast::DataReaderQos qos = with(fast::DATAREADER_QOS_DEFAULT, wanted);
    // What a stranger has blown up is given back when it has been taken.
    qos.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
    const fast::StatusMask mask = fast::StatusMask::subscription_matched()
                                  << fast::StatusMask::data_available();
    reader_ = subscriber_.create_datareader(topic, qos, this, mask);
    if (reader_ == nullptr) throw Error("DDS makes no reader of the topic " + wanted.name);
  }
  ~FastReader() override {
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }
  FastReader(const FastReader&) = delete;
  FastReader& operator=(const FastReader&) = delete;

  std::vector<Sample> take() override {
    std::vector<Sample> samples;
    Payload payload;
    fast::SampleInfo info;
    while (samples.size() < kMostAtOnce) {
      if (reader_->take_next_sample(&payload, &info) != ReturnCode_t::RETCODE_OK) return samples;
      if (!info.valid_data) continue;
      Sample sample{std::move(payload.in), to_sample_id(info.sample_identity), std::nullopt};
      if (info.related_sample_identity.writer_guid() != rtps::GUID_t::unknown())
        sample.related = to_sample_id(info.related_sample_identity);
      samples.push_back(std::move(sample));
    }
    bell_.ring();  // for the rest
    return samples;
  }
  Guid guid() const override { return to_guid(reader_->guid()); }
  std::vector<Guid> writers() const override { return writers_.all(); }

 private:
  void on_data_available(fast::DataReader*) override { bell_.ring(); }
  void on_subscription_matched(fast::DataReader*, const fast::SubscriptionMatchedStatus& status) override {
    writers_.note(status.last_publication_handle, status.current_count_change);
  }

  fast::Subscriber& subscriber_;
  Bell& bell_;
  fast::DataReader* reader_;
  Matched writers_;
};

/// The endpoints of others, and what they show of themselves.
class Others : public fast::DomainParticipantListener {
 public:
  std::string user_data_of(const Guid& endpoint) const {
    const std::lock_guard lock(mutex_);
    const auto found = known_.find(endpoint);
    return found == known_.end() ? "" : found->second.user_data;
  }
  std::vector<RemoteEndpoint> endpoints() const {
    const std::lock_guard lock(mutex_);
    std::vector<RemoteEndpoint> all;
    for (const auto& [guid, known] : known_) all.push_back(known.endpoint);
    return all;
  }

 private:
  struct Known {
    RemoteEndpoint endpoint;
    std::string user_data;
  };

  void on_publisher_discovery(fast::DomainParticipant*, rtps::WriterDiscoveryInfo&& found) override {
    note(found.info, true, found.status == found.REMOVED_WRITER);
  }
  void on_subscriber_discovery(fast::DomainParticipant*, rtps::ReaderDiscoveryInfo&& found) override {
    note(found.info, false, found.status == found.REMOVED_READER);
  }
  template <class FastInfo>
  void note(const FastInfo& info, bool writes, bool removed) {
    const Guid guid = to_guid(info.guid());
    const auto& data = info.m_qos.m_userData.getValue();
    const std::lock_guard lock(mutex_);
    if (removed)
      known_.erase(guid);
    else
      known_[guid] = {{guid, writes, info.topicName().to_string(), info.typeName().to_string()},
                      data.size() <= kLongestUserData ? std::string(data.begin(), data.end()) : ""};
  }

  mutable std::mutex mutex_;
  std::map<Guid, Known> known_;
};

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

fast::DomainParticipantQos qos_of(const Discovery& discovery, const std::string& name,
                                  const std::string& user_data, std::shared_ptr<const Gate> gate) {
  fast::DomainParticipantQos qos;
  qos.name(name.c_str());
  qos.user_data().data_vec(octets(user_data));
  const bool here_alone = discovery.range != Range::subnet && discovery.peers.empty();
  qos.transport().use_builtin_transports =
      false;  // shared memory would leave files behind when a program dies
  qos.transport().user_transports.push_back(gated_udp(here_alone, std::move(gate)));
  auto& builtin = qos.wire_protocol().builtin;
  builtin.discovery_config.leaseDuration_announcementperiod =
      eprosima::fastrtps::Duration_t(kAnnouncementPeriod_s);
  builtin.discovery_config.initial_announcements = {
      kFirstAnnouncements, eprosima::fastrtps::Duration_t(kFirstAnnouncementPeriod_s)};
  if (discovery.range == Range::off)
    builtin.discovery_config.discoveryProtocol = rtps::DiscoveryProtocol_t::NONE;
  // A list that is not empty replaces multicast.
  if (discovery.range != Range::subnet)
    builtin.metatrafficUnicastLocatorList.push_back(here_alone ? locator_of(kLoopback, 0)
                                                               : rtps::Locator_t());
  if (discovery.range == Range::localhost) builtin.initialPeersList.push_back(locator_of(kLoopback, 0));
  for (const rtps::Locator_t& peer : locators_of_peers(discovery.peers))
    builtin.initialPeersList.push_back(peer);
  if (discovery.range == Range::subnet && !discovery.peers.empty())
    builtin.initialPeersList.push_back(locator_of(
        kMulticastAddress, kMulticastPort + kPortsPerDomain * static_cast<std::uint32_t>(discovery.domain)));
  return qos;
}

/// Of Fast DDS, with one type for each topic.
class OneParticipant {
 public:
  OneParticipant(const Discovery& discovery, const std::string& name, const std::string& user_data,
                 Others& others) {
    const auto gate = std::make_shared<Gate>();
    participant_ = fast::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(discovery.domain), qos_of(discovery, name, user_data, gate), &others,
        fast::StatusMask::none());
    gate->open();
    if (participant_ == nullptr)
      throw Error("DDS makes no participant in domain " + std::to_string(discovery.domain));
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
  fast::Publisher& publisher() { return *publisher_; }
  fast::Subscriber& subscriber() { return *subscriber_; }

 private:
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
    return std::make_unique<FastWriter>(one.publisher(), one.topic(topic), topic);
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
  /// Several participants of ours find one another.
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

/// Fast DDS prints to standard output, which belongs to the program's own words.
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

}  // namespace astro::ros2::dds
