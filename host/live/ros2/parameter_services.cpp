#include "host/live/ros2/parameter_services.hpp"

#include <chrono>
#include <utility>

#include "host/formats/cdr/codec.hpp"

namespace astro::live {
namespace {

std::int64_t now_ns() {
  return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
}

TopicDescription events_topic() {
  return {"/parameter_events", message_type<ros2::msg::ParameterEvent>(), true, false, 1000};
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
      answers_(table, [this](std::span<const ros2::msg::Parameter> changed) {
        ros2::msg::ParameterEvent event;
        event.changed_parameters.assign(changed.begin(), changed.end());
        tell(std::move(event));
      }) {
  serve<ros2::msg::GetParameters>(middleware, "/get_parameters");
  serve<ros2::msg::GetParameterTypes>(middleware, "/get_parameter_types");
  serve<ros2::msg::SetParameters>(middleware, "/set_parameters");
  serve<ros2::msg::SetParametersAtomically>(middleware, "/set_parameters_atomically");
  serve<ros2::msg::DescribeParameters>(middleware, "/describe_parameters");
  serve<ros2::msg::ListParameters>(middleware, "/list_parameters");
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
    const std::optional<Request> request = ros2::decode<Request>(bytes);
    if (!request || too_long(*request)) return std::nullopt;
    return ros2::encode(answers_.to(*request));
  });
}

void ParameterServices::look() {
  std::set<std::string> names;
  for (ros2::msg::ParameterDescriptor& each : table_.descriptors()) names.insert(std::move(each.name));
  if (names == known_) return;
  ros2::msg::ParameterEvent event;
  for (const std::string& name : names)
    if (!known_.contains(name))
      if (auto value = table_.value(name)) event.new_parameters.push_back({name, std::move(*value)});
  for (const std::string& name : known_)
    if (!names.contains(name)) event.deleted_parameters.push_back({name, {}});
  known_ = std::move(names);
  tell(std::move(event));
}

void ParameterServices::tell(ros2::msg::ParameterEvent event) {
  const std::int64_t time_ns = now_ns();
  event.stamp = ros2::msg::to_time(time_ns);
  event.node = node_;
  events_->publish(ros2::encode(event), time_ns);
}

}  // namespace astro::live
