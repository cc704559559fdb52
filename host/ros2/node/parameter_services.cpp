#include "host/ros2/node/parameter_services.hpp"

#include <chrono>
#include <utility>

#include "host/ros2/cdr/codec.hpp"

namespace astro::ros2 {
namespace {

std::int64_t now_ns() {
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

TopicDescription events_topic() {
  return {"/parameter_events", message_type<msg::ParameterEvent>(), true, false, 1000};
}

template <class List>
bool too_many(const List& list) {
  return list.size() > ParameterServices::kMostNames;
}

template <class Request>
bool too_long(const Request& request) {
  if constexpr (requires { request.names; })
    return too_many(request.names);
  else if constexpr (requires { request.parameters; })
    return too_many(request.parameters);
  else
    return too_many(request.prefixes);
}

}  // namespace

ParameterServices::ParameterServices(Middleware& middleware, ParameterTable& table, const std::string& node)
    : table_(table),
      node_(node),
      events_(middleware.advertise(events_topic())),
      answers_(table, [this](std::span<const msg::Parameter> changed) {
        msg::ParameterEvent event;
        event.changed_parameters.assign(changed.begin(), changed.end());
        tell(std::move(event));
      }) {
  serve<msg::GetParameters>(middleware, "/get_parameters");
  serve<msg::GetParameterTypes>(middleware, "/get_parameter_types");
  serve<msg::SetParameters>(middleware, "/set_parameters");
  serve<msg::SetParametersAtomically>(middleware, "/set_parameters_atomically");
  serve<msg::DescribeParameters>(middleware, "/describe_parameters");
  serve<msg::ListParameters>(middleware, "/list_parameters");
}

template <class Service>
void ParameterServices::serve(Middleware& middleware, const std::string& name) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  const ServiceDescription description{
      node_ + name, Service::kType, message_type<Request>(), message_type<Response>(), false, [this] {
        return table_.is_fresh();
      }};
  middleware.serve(description, [this](ByteView bytes) -> std::optional<Bytes> {
    const std::optional<Request> request = decode<Request>(bytes);
    if (!request || too_long(*request)) return std::nullopt;
    return encode(answers_.to(*request));
  });
}

void ParameterServices::look() {
  std::set<std::string> names;
  for (msg::ParameterDescriptor& each : table_.descriptors()) names.insert(std::move(each.name));
  if (names == known_) return;
  msg::ParameterEvent event;
  for (const std::string& name : names)
    if (!known_.contains(name))
      if (auto value = table_.value(name)) event.new_parameters.push_back({name, std::move(*value)});
  for (const std::string& name : known_)
    if (!names.contains(name)) event.deleted_parameters.push_back({name, {}});
  known_ = std::move(names);
  tell(std::move(event));
}

void ParameterServices::tell(msg::ParameterEvent event) {
  const std::int64_t time_ns = now_ns();
  event.stamp = msg::to_time(time_ns);
  event.node = node_;
  events_->publish(encode(event), time_ns);
}

}  // namespace astro::ros2
