#include "host/live/foxglove/session.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/base/error.hpp"
#include "host/live/foxglove/server_messages.hpp"

namespace astro::foxglove {
namespace {

constexpr std::size_t kMostWatched = 1024;

/// Viewers also write "geometry_msgs/Twist".
bool is_type(std::string_view name, std::string_view type) {
  if (name == type) return true;
  const std::size_t slash = type.find('/');
  const std::string short_name =
      std::string(type.substr(0, slash)) + std::string(type.substr(type.rfind('/')));
  return name == short_name;
}

std::string viewer(ClientId id) { return fmt::format("viewer {}", id); }

}  // namespace

Session::Session(ClientId id, const Catalogue& catalogue, Watchers& watchers, RequestSink sink)
    : id_(id), catalogue_(catalogue), watchers_(watchers), sink_(std::move(sink)) {
  queue_.push_text(server_info(catalogue));
  if (!catalogue.channels.empty()) queue_.push_text(foxglove::advertise(catalogue.channels));
  if (!catalogue.services.empty()) queue_.push_text(advertise_services(catalogue.services));
}

Session::~Session() {
  if (watches()) --watchers_.now;
  for (const auto& [channel, subscription] : subscription_of_)
    --*find(catalogue_.channels, channel)->subscribers;
}

void Session::complain(const std::string& sentence) { queue_.push_text(status(Level::error, sentence)); }

void Session::receive(bool is_text, ByteView message) {
  try {
    std::visit([this](const auto& each) { take(each); },
               is_text ? parse_text(as_text(message)) : parse_binary(message));
  } catch (const Error& error) {
    complain(error.what());
  }
}

bool Session::admit_watcher() {
  if (watches()) return true;
  if (watchers_.now >= Watchers::kMost) watchers_.make_room();
  return watchers_.now < Watchers::kMost;
}

void Session::take(const Subscribe& message) {
  if (!admit_watcher())
    return complain(fmt::format("{} viewers watch already, and this one can only ask and stop the robot",
                                Watchers::kMost));
  for (const Subscribe::Subscription& each : message.subscriptions) subscribe(each);
}

void Session::subscribe(const Subscribe::Subscription& wanted) {
  const Channel* channel = find(catalogue_.channels, wanted.channel);
  if (channel == nullptr) return complain(fmt::format("there is no channel {}", wanted.channel));
  if (channel_of_.contains(wanted.id))
    return complain(fmt::format("there is a subscription {} already", wanted.id));
  const bool is_first = subscription_of_.empty();
  if (!subscription_of_.emplace(wanted.channel, wanted.id).second)
    return complain(fmt::format("channel {} is subscribed already", wanted.channel));
  if (is_first) ++watchers_.now;
  channel_of_.emplace(wanted.id, wanted.channel);
  ++*channel->subscribers;
  for (const SharedSample& sample : channel->kept) queue_.push_latched(wanted.id, sample);
}

void Session::take(const Unsubscribe& message) {
  for (const std::uint32_t id : message.ids) {
    const auto found = channel_of_.find(id);
    if (found == channel_of_.end()) {
      complain(fmt::format("there is no subscription {}", id));
      continue;
    }
    --*find(catalogue_.channels, found->second)->subscribers;
    subscription_of_.erase(found->second);
    channel_of_.erase(found);
    if (!watches()) --watchers_.now;
    queue_.forget(id);
  }
}

void Session::take(const Advertise& message) {
  for (const Advertise::Channel& each : message.channels) advertise(each);
}

void Session::advertise(const Advertise::Channel& offered) {
  if (inlet_of_.contains(offered.id))
    return complain(fmt::format("channel {} is advertised already", offered.id));
  if (inlet_of_.size() >= kMostAdvertised)
    return complain(fmt::format("more than {} channels are advertised", kMostAdvertised));
  if (offered.encoding != kEncoding)
    return complain(fmt::format("messages come as '{}', not as '{}'", kEncoding, offered.encoding));
  const auto found =
      std::find_if(catalogue_.inlets.begin(), catalogue_.inlets.end(), [&](const Inlet& inlet) {
        return inlet.topic.name == offered.topic && is_type(offered.schema_name, inlet.topic.type.name);
      });
  if (found == catalogue_.inlets.end())
    return complain(
        fmt::format("the robot does not take '{}' as {} from here", offered.topic, offered.schema_name));
  inlet_of_.emplace(offered.id, found->id);
}

void Session::take(const Unadvertise& message) {
  for (const std::uint32_t id : message.ids)
    if (inlet_of_.erase(id) == 0) complain(fmt::format("no channel {} is advertised", id));
}

void Session::take(const Publish& message) {
  const auto found = inlet_of_.find(message.channel);
  if (found == inlet_of_.end()) return complain(fmt::format("no channel {} is advertised", message.channel));
  sink_(MessageArrived{found->second, Bytes(message.data.begin(), message.data.end())});
}

bool Session::admit_question() {
  if (questions_ >= kMostQuestions) return false;
  ++questions_;
  return true;
}

void Session::take(const ServiceCall& message) {
  const auto refuse = [&](const std::string& why) {
    queue_.push_text(service_call_failure(message.service, message.call, why));
  };
  if (find(catalogue_.services, message.service) == nullptr)
    return refuse(fmt::format("there is no service {}", message.service));
  if (message.encoding != kEncoding)
    return refuse(fmt::format("requests come as '{}', not as '{}'", kEncoding, message.encoding));
  if (message.data.size() > kLongestQuestion)
    return refuse(
        fmt::format("a request has at most {} bytes, this one {}", kLongestQuestion, message.data.size()));
  if (!admit_question()) return refuse("the robot has not answered earlier questions yet");
  sink_(CallArrived{id_, message.service, message.call, Bytes(message.data.begin(), message.data.end())});
}

void Session::take(const GetParameters& message) {
  if (!admit_question()) return complain("the robot has not answered earlier questions yet");
  sink_(ParametersAsked{id_, message});
}

void Session::take(const SetParameters& message) {
  if (!admit_question()) return complain("the robot has not answered earlier questions yet");
  sink_(ParametersGiven{id_, message});
}

void Session::take(const WatchParameters& message) {
  if (message.names.empty()) {
    watches_all_ = message.on;
    if (!message.on) watched_.clear();
  }
  for (const std::string& name : message.names) {
    if (!message.on)
      watched_.erase(name);
    else if (watched_.size() < kMostWatched)
      watched_.insert(name);
  }
}

void Session::take(const WatchGraph& message) {
  if (!message.on)
    graph_sent_.reset();
  else if (!graph_sent_)
    graph_sent_.emplace();
}

void Session::offer(const Channel& channel, const SharedSample& sample) {
  const auto found = subscription_of_.find(channel.id);
  if (found == subscription_of_.end()) return;
  if (channel.topic.latched)
    queue_.push_latched(found->second, sample);
  else
    queue_.push_data(found->second, sample);
}

void Session::answer_text(std::string text) {
  --questions_;
  queue_.push_text(std::move(text));
}

void Session::answer_binary(std::string bytes) {
  --questions_;
  queue_.push_binary(std::move(bytes));
}

void Session::parameters_changed(std::span<const ros2::msg::Parameter> parameters) {
  std::vector<ros2::msg::Parameter> told;
  std::copy_if(
      parameters.begin(), parameters.end(), std::back_inserter(told),
      [this](const ros2::msg::Parameter& each) { return watches_all_ || watched_.contains(each.name); });
  if (!told.empty()) queue_.push_text(parameter_values(told, std::nullopt));
}

void Session::send_graph(const ConnectionGraph& graph) {
  if (!graph_sent_ || *graph_sent_ == graph) return;
  queue_.push_text(graph_update(*graph_sent_, graph));
  graph_sent_ = graph;
}

void Session::add_to(ConnectionGraph& graph) const {
  for (const auto& [channel, subscription] : subscription_of_)
    graph.subscribed[find(catalogue_.channels, channel)->topic.name].insert(viewer(id_));
  for (const auto& [number, inlet] : inlet_of_)
    graph.published[find(catalogue_.inlets, inlet)->topic.name].insert(viewer(id_));
}

void Session::report_drops() {
  const std::uint64_t dropped = queue_.dropped() - drops_reported_;
  if (dropped == 0) return;
  drops_reported_ = queue_.dropped();
  queue_.push_text(
      status(Level::warning,
             fmt::format("{} messages were dropped, because this viewer receives more slowly than they come",
                         dropped)));
}

}  // namespace astro::foxglove
