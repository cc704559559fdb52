#include "tests/support/ros2/peers/stock_participant.hpp"

#include <fastdds/rtps/common/WriteParams.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include <algorithm>
#include <list>
#include <map>
#include <stdexcept>

#include "host/live/dds/fast_endpoints.hpp"
#include "host/live/dds/fast_others.hpp"

namespace astro::support {
namespace {

using namespace dds;
namespace transport = eprosima::fastdds::rtps;

fast::DomainParticipantQos settings(bool subnet) {
  fast::DomainParticipantQos qos = fast::PARTICIPANT_QOS_DEFAULT;
  qos.name("/");
  qos.user_data().data_vec(octets("enclave=/;"));
  rtps::BuiltinAttributes& builtin = qos.wire_protocol().builtin;
  builtin.readerHistoryMemoryPolicy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  builtin.writerHistoryMemoryPolicy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  if (subnet) return qos;
  builtin.metatrafficUnicastLocatorList.push_back(rtps::Locator_t());  // instead of multicast
  const auto udp = std::make_shared<transport::UDPv4TransportDescriptor>();
  udp->maxInitialPeersRange = 32;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {std::make_shared<transport::SharedMemTransportDescriptor>(), udp};
  rtps::Locator_t localhost;
  rtps::IPLocator::setIPv4(localhost, "127.0.0.1");
  builtin.initialPeersList.push_back(localhost);
  return qos;
}

template <class FastQos>
FastQos with(FastQos qos, const Topic& topic) {
  qos.reliability().kind =
      topic.qos.reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      topic.qos.transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
  qos.history().kind = fast::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = topic.qos.depth;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  qos.user_data().data_vec(octets(topic.user_data));
  return qos;
}

class StockWriter : public Writer, fast::DataWriterListener {
 public:
  StockWriter(fast::Publisher& publisher, fast::Topic* topic, const Topic& wanted) : publisher_(publisher) {
    fast::DataWriterQos qos = with(fast::DATAWRITER_QOS_DEFAULT, wanted);
    qos.publish_mode().kind = fast::SYNCHRONOUS_PUBLISH_MODE;
    writer_ = publisher_.create_datawriter(topic, qos, this, fast::StatusMask::publication_matched());
  }
  ~StockWriter() override {
    writer_->set_listener(nullptr);
    publisher_.delete_datawriter(writer_);
  }
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
    readers_.note(to_guid(status.last_subscription_handle), status.current_count_change);
  }

  fast::Publisher& publisher_;
  fast::DataWriter* writer_;
  Matched readers_;
};

class StockReader : public Reader, fast::DataReaderListener {
 public:
  StockReader(fast::Subscriber& subscriber, fast::Topic* topic, const Topic& wanted)
      : subscriber_(subscriber),
        reader_(subscriber_.create_datareader(topic, with(fast::DATAREADER_QOS_DEFAULT, wanted), this,
                                              fast::StatusMask::subscription_matched())) {}
  ~StockReader() override {
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }
  std::vector<Sample> take() override {
    std::vector<Sample> samples;
    Payload payload;
    fast::SampleInfo info;
    while (reader_->take_next_sample(&payload, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data)
        samples.push_back({std::move(payload.in), to_sample_id(info.sample_identity),
                           to_sample_id(info.related_sample_identity)});
    return samples;
  }
  Guid guid() const override { return to_guid(reader_->guid()); }
  std::vector<Guid> writers() const override { return writers_.all(); }

 private:
  void on_subscription_matched(fast::DataReader*, const fast::SubscriptionMatchedStatus& status) override {
    writers_.note(to_guid(status.last_publication_handle), status.current_count_change);
  }

  fast::Subscriber& subscriber_;
  Matched writers_;
  fast::DataReader* reader_;
};

/// As one node is, with one type for each topic.
class OneNode {
 public:
  OneNode(int domain, bool subnet, Others& others)
      : participant_(fast::DomainParticipantFactory::get_instance()->create_participant(
            static_cast<std::uint32_t>(domain), settings(subnet), &others, fast::StatusMask::none())) {
    if (participant_ == nullptr) throw std::runtime_error("Fast DDS makes no participant");
    publisher = participant_->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
    subscriber = participant_->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  }
  ~OneNode() {
    participant_->set_listener(nullptr);
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  OneNode(const OneNode&) = delete;
  OneNode& operator=(const OneNode&) = delete;

  bool takes(const Topic& topic) const {
    const auto found = topics_.find(topic.name);
    return found == topics_.end() || found->second->get_type_name() == topic.type;
  }
  fast::Topic* topic(const Topic& wanted) {
    fast::Topic*& topic = topics_[wanted.name];
    if (topic == nullptr) {
      fast::TypeSupport(new OpaqueType(wanted.type)).register_type(participant_);
      topic = participant_->create_topic(wanted.name, wanted.type, fast::TOPIC_QOS_DEFAULT);
    }
    return topic;
  }
  Guid guid() const { return to_guid(participant_->guid()); }

  fast::Publisher* publisher;
  fast::Subscriber* subscriber;

 private:
  fast::DomainParticipant* participant_;
  std::map<std::string, fast::Topic*> topics_;
};

class StockParticipant : public Participant {
 public:
  StockParticipant(int domain, bool subnet) : domain_(domain), subnet_(subnet) {}

  std::unique_ptr<Writer> create_writer(const Topic& topic) override {
    OneNode& node = node_for(topic);
    return std::make_unique<StockWriter>(*node.publisher, node.topic(topic), topic);
  }
  std::unique_ptr<Reader> create_reader(const Topic& topic) override {
    OneNode& node = node_for(topic);
    return std::make_unique<StockReader>(*node.subscriber, node.topic(topic), topic);
  }
  Guid guid() const override { return nodes_.front().guid(); }
  std::vector<RemoteEndpoint> remote_endpoints() const override { return others_.endpoints(); }
  std::string user_data_of(const Guid& endpoint) const override { return others_.user_data_of(endpoint); }
  void wait(std::chrono::microseconds) override {}

 private:
  OneNode& node_for(const Topic& topic) {
    const auto found = std::ranges::find_if(nodes_, [&](const OneNode& node) { return node.takes(topic); });
    return found != nodes_.end() ? *found : nodes_.emplace_back(domain_, subnet_, others_);
  }

  int domain_;
  bool subnet_;
  Others others_;
  std::list<OneNode> nodes_;
};

}  // namespace

std::unique_ptr<Participant> open_stock_participant(int domain, bool subnet) {
  return std::make_unique<StockParticipant>(domain, subnet);
}

}  // namespace astro::support
