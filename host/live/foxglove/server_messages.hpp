#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/formats/messages/parameters.hpp"
#include "host/live/foxglove/catalogue.hpp"

/// What the server sends: JSON, and binary frames whose first byte says what they are. Text that is no UTF-8 is repaired.
///
/// Source  Foxglove WebSocket protocol, version 1.
namespace astro::foxglove {

inline constexpr std::string_view kEncoding = "cdr", kSchemaEncoding = "ros2msg";

enum class Level { info = 0, warning = 1, error = 2 };

/// The first message of a connection.
std::string server_info(const Catalogue& catalogue);
std::string advertise(std::span<const Channel> channels);
std::string advertise_services(std::span<const Service> services);
std::string status(Level level, std::string_view message);
/// `id`: that of the request that it answers.
std::string parameter_values(std::span<const ros2::msg::Parameter> parameters,
                             const std::optional<std::string>& id);
std::string service_call_failure(std::uint32_t service, std::uint32_t call, std::string_view message);
/// What has changed between the two graphs.
std::string graph_update(const ConnectionGraph& before, const ConnectionGraph& after);

/// What stands before the payload of a message: kind, subscription, time.
std::string data_header(std::uint32_t subscription, std::int64_t time_ns);
std::string service_response(std::uint32_t service, std::uint32_t call, ByteView response);

}  // namespace astro::foxglove
