#include "host/live/foxglove/hub.hpp"

#include <algorithm>

#include "host/live/foxglove/server_messages.hpp"

namespace astro::foxglove {

Hub::Hub(std::string name, std::string session_id, bool takes_messages, RequestSink sink)
    : sink_(std::move(sink)) {
  catalogue_.name = std::move(name);
  catalogue_.session_id = std::move(session_id);
  catalogue_.takes_messages = takes_messages;
}

void Hub::add(Channel channel) {
  catalogue_.channels.push_back(std::move(channel));
  for (Session& each : sessions_) each.queue().push_text(advertise({&catalogue_.channels.back(), 1}));
}

void Hub::add(Inlet inlet) { catalogue_.inlets.push_back(std::move(inlet)); }

void Hub::add(Service service) {
  catalogue_.services.push_back(std::move(service));
  for (Session& each : sessions_)
    each.queue().push_text(advertise_services({&catalogue_.services.back(), 1}));
}

Session& Hub::join() { return sessions_.emplace_back(++last_client_, catalogue_, watchers_, sink_); }

void Hub::leave(ClientId id) {
  sessions_.remove_if([id](const Session& each) { return each.id() == id; });
}

Session* Hub::session(ClientId id) {
  const auto found =
      std::find_if(sessions_.begin(), sessions_.end(), [id](const Session& each) { return each.id() == id; });
  return found == sessions_.end() ? nullptr : &*found;
}

void Hub::publish(std::uint32_t id, SharedSample sample) {
  Channel& channel = *find(catalogue_.channels, id);
  for (Session& each : sessions_) each.offer(channel, sample);
  if (!channel.topic.latched) return;
  channel.kept.push_back(std::move(sample));
  if (channel.kept.size() > static_cast<std::size_t>(std::max(channel.topic.depth, 1)))
    channel.kept.pop_front();
}

void Hub::answer_text(ClientId client, std::string text) {
  if (Session* found = session(client)) found->answer_text(std::move(text));
}

void Hub::answer_binary(ClientId client, std::string bytes) {
  if (Session* found = session(client)) found->answer_binary(std::move(bytes));
}

void Hub::tell(ClientId client, std::string text) {
  if (Session* found = session(client)) found->queue().push_text(std::move(text));
}

void Hub::parameters_changed(std::span<const ros2::msg::Parameter> parameters) {
  for (Session& each : sessions_) each.parameters_changed(parameters);
}

bool Hub::parameters_are_watched() const {
  return std::any_of(sessions_.begin(), sessions_.end(),
                     [](const Session& each) { return each.watches_parameters(); });
}

ConnectionGraph Hub::graph() const {
  ConnectionGraph graph;
  for (const Channel& each : catalogue_.channels) graph.published[each.topic.name].insert(catalogue_.name);
  for (const Inlet& each : catalogue_.inlets) graph.subscribed[each.topic.name].insert(catalogue_.name);
  for (const Service& each : catalogue_.services) graph.services[each.service.name].insert(catalogue_.name);
  for (const Session& each : sessions_) each.add_to(graph);
  return graph;
}

void Hub::report() {
  for (Session& each : sessions_) each.report_drops();
  if (std::none_of(sessions_.begin(), sessions_.end(),
                   [](const Session& each) { return each.watches_graph(); }))
    return;
  const ConnectionGraph now = graph();
  for (Session& each : sessions_) each.send_graph(now);
}

}  // namespace astro::foxglove
