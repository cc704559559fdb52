#include "host/live/ros2/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <set>
#include <utility>

#include "host/live/dds/fast_dds.hpp"
#include "host/live/ros2/parameter_services.hpp"
#include "host/live/ros2/service.hpp"
#include "host/live/ros2/twin_watch.hpp"

namespace astro::live {
namespace {

dds::Topic wire_topic(const TopicDescription& topic) {
  return {ros2::wire_name_of_topic(topic.name),
          ros2::dds_type_name(topic.type.name),
          {.reliable = topic.reliable, .transient_local = topic.latched, .depth = topic.depth},
          "typehash=" + std::string(topic.type.hash) + ';'};
}

class NodePublisher : public Publisher {
 public:
  NodePublisher(std::unique_ptr<dds::Writer> writer, DiscoveryInfo& info)
      : info_(info), writer_(std::move(writer)) {
    info_.add_writer(writer_->guid());
  }
  ~NodePublisher() override { info_.remove_writer(writer_->guid()); }
  NodePublisher(const NodePublisher&) = delete;
  NodePublisher& operator=(const NodePublisher&) = delete;

  void publish(ByteView message, std::int64_t /*time_ns: DDS stamps what it sends by itself*/) override {
    writer_->write(message);
  }
  bool has_subscribers() const override { return !writer_->readers().empty(); }

 private:
  DiscoveryInfo& info_;
  std::unique_ptr<dds::Writer> writer_;
};

struct Subscription {
  std::string name;
  dds::Topic topic;
  std::unique_ptr<dds::Reader> reader;
  Middleware::OnMessage on_message;
};

class Node : public Middleware {
 public:
  Node(const NodeOptions& options, std::unique_ptr<dds::Participant> participant)
      : name_(ros2::valid(options.name)),
        on_twin_(options.on_twin),
        on_foreign_type_(options.on_foreign_type),
        participant_(std::move(participant)),
        info_(*participant_, name_, options.gid_size) {}

  std::unique_ptr<Publisher> advertise(const TopicDescription& topic) override {
    return std::make_unique<NodePublisher>(participant_->create_writer(wire_topic(topic)), info_);
  }
  void subscribe(const TopicDescription& topic, OnMessage on_message) override {
    const dds::Topic on_wire = wire_topic(topic);
    subscriptions_.push_back(
        {topic.name, on_wire, participant_->create_reader(on_wire), std::move(on_message)});
    info_.add_reader(subscriptions_.back().reader->guid());
  }
  void serve(const ServiceDescription& service, OnRequest on_request) override {
    services_.emplace_back(*participant_, service, next_service_id(), std::move(on_request));
    info_.add_reader(services_.back().reader());
    info_.add_writer(services_.back().writer());
  }
  void serve_parameters(ParameterTable& table) override {
    parameters_.push_back(std::make_unique<ParameterServices>(*this, table, ros2::full_name(name_)));
  }

  void poll() override {
    info_.publish_changes();
    for (Subscription& subscription : subscriptions_)
      for (const dds::Sample& sample : subscription.reader->take()) subscription.on_message(sample.payload);
    for (Service& service : services_) service.collect();
    const auto until = Service::Clock::now() + kShare;
    do {
      poll_urgent();
      left_ = answer_one();
    } while (left_ && Service::Clock::now() < until);
    for (Service& service : services_) service.send_replies(Service::Clock::now());
    watch_others(TwinWatch::Clock::now());
  }
  void poll_urgent() override {
    for (Service& service : services_)
      if (service.urgent()) service.poll(Service::Clock::now());
  }
  void wait(std::chrono::microseconds timeout) override {
    participant_->wait(left_ ? std::chrono::microseconds::zero() : timeout);
  }

 private:
  /// After this time a poll() begins no further call, so that waiting calls do not block the robot's thread.
  static constexpr std::chrono::milliseconds kShare{5};

  void watch_others(TwinWatch::Clock::time_point now) {
    constexpr std::chrono::seconds kBetweenLooks{1};
    if (now < look_at_) return;
    look_at_ = now + kBetweenLooks;
    const std::vector<dds::RemoteEndpoint> others = participant_->remote_endpoints();
    watch_for_twin(others, now);
    watch_for_foreign_types(others);
    for (const auto& each : parameters_) each->look();
  }
  void watch_for_foreign_types(const std::vector<dds::RemoteEndpoint>& others) {
    constexpr std::size_t kMostTold = 20;
    for (const Subscription& each : subscriptions_)
      for (const dds::RemoteEndpoint& other : others) {
        if (!other.writes || other.topic != each.topic.name || takes(other)) continue;
        const auto type = ros2::ros_type_name(other.type);
        if (type && told_types_.size() < kMostTold && told_types_.emplace(each.name, *type).second)
          on_foreign_type_(each.name, *type);
      }
  }
  bool takes(const dds::RemoteEndpoint& other) const {
    return std::ranges::any_of(subscriptions_, [&](const Subscription& each) {
      return each.topic.name == other.topic && each.topic.type == other.type;
    });
  }
  /// Another node of the same full name is recognised by its parameter services, which have that name.
  void watch_for_twin(const std::vector<dds::RemoteEndpoint>& others, TwinWatch::Clock::time_point now) {
    const std::string name = ros2::full_name(name_);
    const std::string replies = ros2::wire_name_of_replies(name + "/get_parameters");
    const bool is_there =
        std::ranges::any_of(others, [&](const auto& each) { return each.writes && each.topic == replies; });
    if (twin_.note(is_there, now)) on_twin_(name);
  }

  /// Services take turns. False if no call can be answered.
  bool answer_one() {
    for (std::size_t i = 0; i < services_.size(); ++i) {
      Service& service = services_.front();
      services_.splice(services_.end(), services_, services_.begin());
      if (service.answer_next(Service::Clock::now())) return true;
    }
    return false;
  }
  std::string next_service_id() {
    return fmt::format("{:02x}.{}", fmt::join(participant_->guid().bytes, "."), services_.size());
  }

  const ros2::NodeName name_;
  std::function<void(const std::string&)> on_twin_;
  std::function<void(const std::string&, const std::string&)> on_foreign_type_;
  std::set<std::pair<std::string, std::string>> told_types_;
  TwinWatch twin_;
  TwinWatch::Clock::time_point look_at_{};
  std::unique_ptr<dds::Participant> participant_;
  DiscoveryInfo info_;
  // Lists, so that a callback may subscribe and serve, too.
  std::list<Subscription> subscriptions_;
  std::list<Service> services_;
  bool left_ = false;  // calls may be left from the last poll()
  std::list<std::unique_ptr<ParameterServices>> parameters_;
};

}  // namespace

std::unique_ptr<Middleware> open_node(const NodeOptions& options, const dds::Discovery& discovery) {
  const std::string name = ros2::full_name(ros2::valid(options.name));
  return open_node(options, dds::open_fast_dds(discovery, name, kParticipantUserData));
}

std::unique_ptr<Middleware> open_node(const NodeOptions& options,
                                      std::unique_ptr<dds::Participant> participant) {
  return std::make_unique<Node>(options, std::move(participant));
}

}  // namespace astro::live
