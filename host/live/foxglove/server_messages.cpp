#include "host/live/foxglove/server_messages.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/live/foxglove/parameter_json.hpp"

namespace astro::foxglove {
namespace {

using nlohmann::json;

constexpr std::uint8_t kData = 1, kServiceResponse = 3;

std::string dump(const json& object) { return object.dump(-1, ' ', false, json::error_handler_t::replace); }

json schema(const live::MessageType& type) {
  return {{"encoding", kEncoding},
          {"schemaName", type.name},
          {"schemaEncoding", kSchemaEncoding},
          {"schema", type.definition}};
}

/// The entries that are new or have changed. A name that nobody uses any more has an empty list, unless it is in `removed`.
json changed(const ConnectionGraph::Ends& before, const ConnectionGraph::Ends& after, const json& removed,
             const char* whose) {
  json list = json::array();
  for (const auto& [name, ids] : after) {
    const auto old = before.find(name);
    if (old == before.end() || old->second != ids) list.push_back({{"name", name}, {whose, ids}});
  }
  for (const auto& [name, ids] : before)
    if (!after.contains(name) && std::find(removed.begin(), removed.end(), name) == removed.end())
      list.push_back({{"name", name}, {whose, json::array()}});
  return list;
}

std::string text_of(const Bytes& bytes) { return std::string(as_text(bytes)); }

}  // namespace

std::string server_info(const Catalogue& catalogue) {
  json capabilities{"services", "connectionGraph"};
  if (catalogue.takes_messages) capabilities.push_back("clientPublish");
  if (catalogue.has_parameters) {
    capabilities.push_back("parameters");
    capabilities.push_back("parametersSubscribe");
  }
  return dump({{"op", "serverInfo"},
               {"name", catalogue.name},
               {"capabilities", capabilities},
               {"supportedEncodings", {kEncoding}},
               {"metadata", json::object()},
               {"sessionId", catalogue.session_id}});
}

std::string advertise(std::span<const Channel> channels) {
  json list = json::array();
  for (const Channel& channel : channels) {
    json each = schema(channel.topic.type);
    each["id"] = channel.id;
    each["topic"] = channel.topic.name;
    list.push_back(std::move(each));
  }
  return dump({{"op", "advertise"}, {"channels", list}});
}

std::string advertise_services(std::span<const Service> services) {
  json list = json::array();
  for (const Service& each : services)
    list.push_back({{"id", each.id},
                    {"name", each.service.name},
                    {"type", each.service.type},
                    {"request", schema(each.service.request)},
                    {"response", schema(each.service.response)}});
  return dump({{"op", "advertiseServices"}, {"services", list}});
}

std::string status(Level level, std::string_view message) {
  return dump({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::string parameter_values(std::span<const ros2::msg::Parameter> parameters,
                             const std::optional<std::string>& id) {
  json list = json::array();
  for (const ros2::msg::Parameter& each : parameters) list.push_back(to_json(each));
  json object{{"op", "parameterValues"}, {"parameters", list}};
  if (id) object["id"] = *id;
  return dump(object);
}

std::string service_call_failure(std::uint32_t service, std::uint32_t call, std::string_view message) {
  return dump({{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", message}});
}

std::string graph_update(const ConnectionGraph& before, const ConnectionGraph& after) {
  json topics = json::array(), services = json::array();
  for (const std::string& name : before.topics())
    if (!after.topics().contains(name)) topics.push_back(name);
  for (const auto& [name, ids] : before.services)
    if (!after.services.contains(name)) services.push_back(name);
  return dump({{"op", "connectionGraphUpdate"},
               {"publishedTopics", changed(before.published, after.published, topics, "publisherIds")},
               {"subscribedTopics", changed(before.subscribed, after.subscribed, topics, "subscriberIds")},
               {"advertisedServices", changed(before.services, after.services, services, "providerIds")},
               {"removedTopics", topics},
               {"removedServices", services}});
}

std::string data_header(std::uint32_t subscription, std::int64_t time_ns) {
  Bytes bytes;
  append(bytes, kData);
  append(bytes, subscription);
  append(bytes, time_ns);
  return text_of(bytes);
}

std::string service_response(std::uint32_t service, std::uint32_t call, ByteView response) {
  Bytes bytes;
  append(bytes, kServiceResponse);
  append(bytes, service);
  append(bytes, call);
  append(bytes, static_cast<std::uint32_t>(kEncoding.size()));
  append(bytes, as_bytes(kEncoding));
  append(bytes, response);
  return text_of(bytes);
}

}  // namespace astro::foxglove
