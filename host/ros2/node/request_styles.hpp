#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "host/ros2/dds/participant.hpp"

/// The two ways in which ROS 2 calls services over DDS, which do not understand each other:
///
///   rmw_fastrtps    the message alone; which reader waits for the reply, and for which request, is carried beside the payload
///   rmw_cyclonedds  16 bytes in front of the message, a client's number and the request's, which the reply repeats; the
///                   client's two endpoints show the same "clientid=...;"
///
/// Source  rmw_fastrtps_shared_cpp: rmw_request.cpp, rmw_response.cpp; rmw_cyclonedds_cpp: serdata.cpp, rmw_node.cpp.
namespace astro::ros2 {

/// In the manner of rmw_fastrtps. `id.writer` is the client's reader of replies, or its writer of requests where an old client
/// does not say.
struct FastCaller {
  dds::SampleId id;
};

/// In the manner of rmw_cyclonedds.
struct CycloneCaller {
  std::string client_id;  // as its endpoints show it
  std::uint64_t client = 0;
  std::int64_t number = 0;
};

/// Whom a request comes from, and the message in it.
struct Call {
  std::variant<FastCaller, CycloneCaller> caller;
  Bytes request;
};

/// `user_data`: what the request's writer shows. Nothing if the bytes are no request.
std::optional<Call> read_call(const dds::Sample& sample, std::string_view user_data);

/// What the answer to a caller in the manner of rmw_cyclonedds is on the wire. `response` is CDR, little-endian.
Bytes cyclone_reply(const CycloneCaller& caller, ByteView response);

/// The value of "key=value;" in an endpoint's user data, "" if there is none.
std::string value_in(std::string_view user_data, std::string_view key);

/// Whether the identifier is that of a reader, not of a writer.
bool is_reader(const dds::Guid& endpoint);

}  // namespace astro::ros2
