#include "host/live/dds/fast_endpoints.hpp"

#include <fastdds/rtps/common/WriteParams.h>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <utility>

#include "host/base/error.hpp"

namespace astro::dds {
namespace {

// A sample that a reader missed, because it had not yet found the writer, is sent again after this time; the default is 3 s.
constexpr double kHeartbeatPeriod_s = 0.1;

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

}  // namespace

FastWriter::FastWriter(fast::Publisher& publisher, fast::Topic* topic, const Topic& wanted,
                       AcknowledgedBy& acknowledged)
    : publisher_(publisher), acknowledged_(acknowledged) {
  fast::DataWriterQos qos = with(fast::DATAWRITER_QOS_DEFAULT, wanted);
  qos.publish_mode().kind = fast::SYNCHRONOUS_PUBLISH_MODE;
  qos.reliable_writer_qos().times.heartbeatPeriod = eprosima::fastrtps::Duration_t(kHeartbeatPeriod_s);
  qos.writer_data_lifecycle().autodispose_unregistered_instances = false;
  writer_ = publisher_.create_datawriter(topic, qos, this, fast::StatusMask::publication_matched());
  if (writer_ == nullptr) throw Error("DDS makes no writer of the topic " + wanted.name);
}

FastWriter::~FastWriter() {
  writer_->set_listener(nullptr);
  for (const Guid& reader : readers_.all()) acknowledged_.forget({reader, guid()});
  publisher_.delete_datawriter(writer_);
}

void FastWriter::send(ByteView payload, const SampleId* related) {
  Payload sample{payload, {}};
  rtps::WriteParams parameters;
  if (related != nullptr) parameters.related_sample_identity(from_sample_id(*related));
  writer_->write(&sample, parameters);
}

std::vector<Guid> FastWriter::certain_readers() const {
  return readers_.those([&](const Guid& reader, std::chrono::steady_clock::duration since) {
    return since >= kWithoutAcknowledgement || acknowledged_.has({reader, guid()});
  });
}

void FastWriter::on_publication_matched(fast::DataWriter* writer,
                                        const fast::PublicationMatchedStatus& status) {
  const rtps::GUID_t other = rtps::iHandle2GUID(status.last_subscription_handle);
  const Acknowledgement first{to_guid(other), to_guid(writer->guid())};
  if (status.current_count_change > 0)
    acknowledged_.expect(first);
  else
    acknowledged_.forget(first);
  if (other.is_on_same_process_as(writer->guid()))
    acknowledged_.note(first);  // it gets samples without the network
  readers_.note(first.reader, status.current_count_change);
}

FastReader::FastReader(fast::Subscriber& subscriber, fast::Topic* topic, const Topic& wanted, Bell& bell)
    : subscriber_(subscriber), bell_(bell) {
  fast::DataReaderQos qos = with(fast::DATAREADER_QOS_DEFAULT, wanted);
  // Memory that a stranger's large sample takes is released when the sample has been taken.
  qos.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  const fast::StatusMask mask = fast::StatusMask::subscription_matched()
                                << fast::StatusMask::data_available();
  reader_ = subscriber_.create_datareader(topic, qos, this, mask);
  if (reader_ == nullptr) throw Error("DDS makes no reader of the topic " + wanted.name);
}

FastReader::~FastReader() {
  reader_->set_listener(nullptr);
  subscriber_.delete_datareader(reader_);
}

std::vector<Sample> FastReader::take() {
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

void FastReader::on_subscription_matched(fast::DataReader*, const fast::SubscriptionMatchedStatus& status) {
  writers_.note(to_guid(status.last_publication_handle), status.current_count_change);
}

}  // namespace astro::dds
