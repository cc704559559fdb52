#include "host/ros2/node/request_styles.hpp"

#include <algorithm>

#include "host/ros2/cdr/cdr.hpp"

namespace astro::ros2 {
namespace {

constexpr std::size_t kCycloneHeaderBytes = 16;

std::optional<Call> read_cyclone_call(ByteView payload, std::string client_id) {
  CdrReader in(payload);
  CycloneCaller caller{std::move(client_id)};
  caller.client = in.number<std::uint64_t>();
  caller.number = in.number<std::int64_t>();
  if (!in.ok()) return std::nullopt;
  Bytes request(payload.begin(), payload.begin() + kCdrHeaderBytes);
  append(request, payload.subspan(kCdrHeaderBytes + kCycloneHeaderBytes));
  return Call{std::move(caller), std::move(request)};
}

}  // namespace

std::optional<Call> read_call(const dds::Sample& sample, std::string_view user_data) {
  if (std::string client_id = value_in(user_data, "clientid"); !client_id.empty())
    return read_cyclone_call(sample.payload, std::move(client_id));
  const dds::Guid& waiting = sample.related ? sample.related->writer : sample.id.writer;
  return Call{FastCaller{{waiting, sample.id.number}}, sample.payload};
}

Bytes cyclone_reply(const CycloneCaller& caller, ByteView response) {
  CdrWriter header;
  header.number(caller.client);
  header.number(caller.number);
  Bytes reply = header.bytes();
  append(reply, response.subspan(std::min(response.size(), kCdrHeaderBytes)));
  return reply;
}

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

// DDSI-RTPS 2.3, table 9.1: the kind of an entity is its last byte.
bool is_reader(const dds::Guid& endpoint) {
  constexpr std::uint8_t kReaderWithoutKey = 0x04, kReaderWithKey = 0x07;
  return endpoint.bytes.back() == kReaderWithoutKey || endpoint.bytes.back() == kReaderWithKey;
}

}  // namespace astro::ros2
