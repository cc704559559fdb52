#include "host/live/foxglove/client_messages.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "host/base/error.hpp"
#include "host/formats/cdr/cdr.hpp"
#include "host/live/foxglove/parameter_json.hpp"

namespace astro::foxglove {
namespace {

using nlohmann::json;

constexpr int kDeepest = 8;  // levels of nested values
constexpr std::uint8_t kPublish = 1, kServiceCall = 2;

/// The part of a message that is quoted in an error, so that the message can be found.
std::string excerpt(std::string_view text) {
  constexpr std::size_t kMostShown = 40;
  return text.size() <= kMostShown ? std::string(text) : std::string(text.substr(0, kMostShown)) + "...";
}

const json& member(const json& object, const char* name) {
  if (object.is_object())
    if (const auto found = object.find(name); found != object.end()) return *found;
  throw Error(fmt::format("there is no '{}' in the message", name), MessageProblem::missing, {name});
}

const json& list(const json& object, const char* name) {
  const json& value = member(object, name);
  if (!value.is_array())
    throw Error(fmt::format("'{}' is not a list", name), MessageProblem::not_a_list, {name});
  if (value.size() > kMostListed)
    throw Error(fmt::format("'{}' has more than {} entries", name, kMostListed),
                MessageProblem::too_many_entries, {name});
  return value;
}

std::uint32_t number(const json& value, const char* name) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX)
    throw Error(fmt::format("'{}' is not a whole number of 32 bits", name), MessageProblem::not_32_bits,
                {name});
  return value.get<std::uint32_t>();
}

std::string text(const json& value, const char* name) {
  if (!value.is_string())
    throw Error(fmt::format("'{}' is not a text", name), MessageProblem::not_a_text, {name});
  const auto& found = value.get_ref<const std::string&>();
  if (found.size() > ros2::kLongestName)
    throw Error(fmt::format("'{}' is longer than {} characters", name, ros2::kLongestName),
                MessageProblem::name_too_long, {name});
  return found;
}

std::uint32_t number_in(const json& object, const char* name) { return number(member(object, name), name); }
std::string text_in(const json& object, const char* name) { return text(member(object, name), name); }

std::optional<std::string> id_in(const json& object) {
  if (!object.contains("id")) return std::nullopt;
  return text_in(object, "id");
}

std::vector<std::uint32_t> numbers_in(const json& object, const char* name) {
  std::vector<std::uint32_t> numbers;
  for (const json& each : list(object, name)) numbers.push_back(number(each, name));
  return numbers;
}

std::vector<std::string> texts_in(const json& object, const char* name) {
  std::vector<std::string> texts;
  for (const json& each : list(object, name)) texts.push_back(text(each, name));
  return texts;
}

ClientMessage subscribe(const json& object) {
  Subscribe message;
  for (const json& each : list(object, "subscriptions"))
    message.subscriptions.push_back({number_in(each, "id"), number_in(each, "channelId")});
  return message;
}

ClientMessage unsubscribe(const json& object) { return Unsubscribe{numbers_in(object, "subscriptionIds")}; }

ClientMessage advertise(const json& object) {
  Advertise message;
  for (const json& each : list(object, "channels"))
    message.channels.push_back({number_in(each, "id"), text_in(each, "topic"), text_in(each, "encoding"),
                                text_in(each, "schemaName")});
  return message;
}

ClientMessage unadvertise(const json& object) { return Unadvertise{numbers_in(object, "channelIds")}; }

ClientMessage get_parameters(const json& object) {
  return GetParameters{texts_in(object, "parameterNames"), id_in(object)};
}

ClientMessage set_parameters(const json& object) {
  SetParameters message{{}, id_in(object)};
  for (const json& each : list(object, "parameters")) {
    std::string name = text_in(each, "name");
    ros2::msg::ParameterValue value = parameter_value_in(each);
    message.parameters.push_back({std::move(name), std::move(value)});
  }
  return message;
}

template <bool on>
ClientMessage watch_parameters(const json& object) {
  return WatchParameters{texts_in(object, "parameterNames"), on};
}

template <bool on>
ClientMessage watch_graph(const json&) {
  return WatchGraph{on};
}

json parse_bounded(std::string_view text) {
  if (text.size() > kLongestText)
    throw Error(fmt::format("a text of {} bytes is longer than {}", text.size(), kLongestText),
                MessageProblem::text_too_long);
  const auto check_depth = [](int depth, json::parse_event_t, const json&) {
    if (depth > kDeepest)
      throw Error(fmt::format("values are nested deeper than {}", kDeepest), MessageProblem::nested_too_deep);
    return true;
  };
  try {
    return json::parse(text.begin(), text.end(), check_depth);
  } catch (const json::exception&) {
    throw Error(fmt::format("'{}' is not JSON", excerpt(text)), MessageProblem::not_json);
  }
}

}  // namespace

ClientMessage parse_text(std::string_view text) {
  static const std::map<std::string_view, ClientMessage (*)(const json&)> kOperations{
      {"subscribe", subscribe},
      {"unsubscribe", unsubscribe},
      {"advertise", advertise},
      {"unadvertise", unadvertise},
      {"getParameters", get_parameters},
      {"setParameters", set_parameters},
      {"subscribeParameterUpdates", watch_parameters<true>},
      {"unsubscribeParameterUpdates", watch_parameters<false>},
      {"subscribeConnectionGraph", watch_graph<true>},
      {"unsubscribeConnectionGraph", watch_graph<false>}};
  const json object = parse_bounded(text);
  const std::string operation = text_in(object, "op");
  const auto found = kOperations.find(operation);
  if (found == kOperations.end())
    throw Error(fmt::format("there is no '{}' here", excerpt(operation)), MessageProblem::unknown_operation,
                {excerpt(operation)});
  return found->second(object);
}

ClientMessage parse_binary(ByteView frame) {
  ByteCursor in(frame);
  const auto kind = in.number<std::uint8_t>();
  ClientMessage message;
  if (kind == kPublish) {
    const auto channel = in.number<std::uint32_t>();
    message = Publish{channel, in.take(in.left())};
  } else if (kind == kServiceCall) {
    ServiceCall call;
    call.service = in.number<std::uint32_t>();
    call.call = in.number<std::uint32_t>();
    call.encoding = as_text(in.take(in.number<std::uint32_t>()));
    call.data = in.take(in.left());
    message = call;
  } else if (in.ok()) {
    throw Error(fmt::format("there are no binary frames of kind {} here", kind),
                MessageProblem::unknown_frame, {std::to_string(kind)});
  }
  if (!in.ok())
    throw Error(fmt::format("a binary frame of {} bytes is too short", frame.size()),
                MessageProblem::frame_too_short);
  return message;
}

}  // namespace astro::foxglove
