#include "host/live/ros2/service.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host/formats/cdr/cdr.hpp"
#include "host/formats/cdr/names.hpp"

namespace astro::live {
namespace {

constexpr std::size_t kCycloneHeaderBytes = 16;

dds::Topic topic_of(std::string name, const MessageType& type, const std::string& id) {
  return {std::move(name),
          ros2::dds_type_name(type.name),
          {.reliable = true, .transient_local = false, .depth = Service::kDepth},
          "serviceid=" + id + ";typehash=" + std::string(type.hash) + ';'};
}

/// The client that has sent a request, and the message in it.
struct Call {
  std::variant<FastCaller, CycloneCaller> caller;
  Bytes request;
};

std::optional<Call> read_cyclone_call(ByteView payload, std::string client_id) {
  ros2::CdrReader in(payload);
  CycloneCaller caller{std::move(client_id)};
  caller.client = in.number<std::uint64_t>();
  caller.number = in.number<std::int64_t>();
  if (!in.ok()) return std::nullopt;
  Bytes request(payload.begin(), payload.begin() + ros2::kCdrHeaderBytes);
  append(request, payload.subspan(ros2::kCdrHeaderBytes + kCycloneHeaderBytes));
  return Call{std::move(caller), std::move(request)};
}

/// `user_data`: what the request's writer shows. Nothing if the bytes are no request.
std::optional<Call> read_call(const dds::Sample& sample, std::string_view user_data) {
  if (std::string client_id = value_in(user_data, "clientid"); !client_id.empty())
    return read_cyclone_call(sample.payload, std::move(client_id));
  const dds::Guid& waiting = sample.related ? sample.related->writer : sample.id.writer;
  return Call{FastCaller{{waiting, sample.id.number}}, sample.payload};
}

/// The reply to a client that uses rmw_cyclonedds, as it is on the wire. `response` is CDR, little-endian.
Bytes cyclone_reply(const CycloneCaller& caller, ByteView response) {
  ros2::CdrWriter header;
  header.number(caller.client);
  header.number(caller.number);
  Bytes reply = std::move(header).bytes();
  append(reply, response.subspan(std::min(response.size(), ros2::kCdrHeaderBytes)));
  return reply;
}

/// Whether the identifier is that of a reader, not of a writer. Its kind is its last byte: DDSI-RTPS 2.3, table 9.1.
bool is_reader(const dds::Guid& endpoint) {
  constexpr std::uint8_t kReaderWithoutKey = 0x04, kReaderWithKey = 0x07;
  return endpoint.bytes.back() == kReaderWithoutKey || endpoint.bytes.back() == kReaderWithKey;
}

}  // namespace

std::string value_in(std::string_view user_data, std::string_view key) {
  while (!user_data.empty()) {
    const std::size_t end = std::min(user_data.find(';'), user_data.size());
    const std::string_view entry = user_data.substr(0, end);
    if (entry.starts_with(key) && entry.substr(key.size()).starts_with('='))
      return std::string(entry.substr(key.size() + 1));
    user_data.remove_prefix(std::min(end + 1, user_data.size()));
  }
  return "";
}

Service::Service(dds::Participant& participant, const ServiceDescription& service, const std::string& id,
                 Middleware::OnRequest on_request)
    : participant_(participant),
      on_request_(std::move(on_request)),
      writer_(participant.create_writer(
          topic_of(ros2::wire_name_of_replies(service.name), service.response, id))),
      reader_(participant.create_reader(
          topic_of(ros2::wire_name_of_requests(service.name), service.request, id))),
      urgent_(service.urgent),
      may_answer_(service.may_answer) {}

void Service::poll(Clock::time_point now) {
  collect();
  while (answer_next(now)) {
  }
  send_replies(now);
}

void Service::collect() {
  if (waiting_.size() >= kDepth) return;  // DDS keeps the newest meanwhile, and no more than kDepth of them
  for (dds::Sample& sample : reader_->take()) waiting_.push_back(std::move(sample));
}

bool Service::answer_next(Clock::time_point now) {
  if (waiting_.empty() || (may_answer_ && !may_answer_())) return false;
  const dds::Sample sample = std::move(waiting_.front());
  waiting_.pop_front();
  answer(sample, now);
  return true;
}

void Service::answer(const dds::Sample& sample, Clock::time_point now) {
  std::optional<Call> call = read_call(sample, participant_.user_data_of(sample.id.writer));
  if (!call) return;
  std::optional<Bytes> response = on_request_(call->request);
  if (!response) return;
  if (held_.size() == kMostHeld) held_.pop_front();
  held_.push_back({std::move(call->caller), std::move(*response), now + kHeldFor});
}

void Service::send_replies(Clock::time_point now) {
  if (held_.empty()) return;
  const std::vector<dds::Guid> readers = writer_->certain_readers();
  std::erase_if(held_, [&](const Reply& reply) {
    const bool found = is_found(reply, readers);
    if (found) send(reply);
    return found || now >= reply.until;
  });
}

bool Service::is_found(const Reply& reply, const std::vector<dds::Guid>& readers) const {
  if (const auto* fast = std::get_if<FastCaller>(&reply.caller))
    return !is_reader(fast->id.writer) ||  // an old client, which does not say which reader it has
           std::find(readers.begin(), readers.end(), fast->id.writer) != readers.end();
  const std::string& client_id = std::get<CycloneCaller>(reply.caller).client_id;
  return std::any_of(readers.begin(), readers.end(), [&](const dds::Guid& reader) {
    return value_in(participant_.user_data_of(reader), "clientid") == client_id;
  });
}

void Service::send(const Reply& reply) {
  if (const auto* fast = std::get_if<FastCaller>(&reply.caller))
    writer_->write(reply.response, fast->id);
  else
    writer_->write(cyclone_reply(std::get<CycloneCaller>(reply.caller), reply.response));
}

}  // namespace astro::live
