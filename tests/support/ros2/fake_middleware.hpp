#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/formats/cdr/codec.hpp"
#include "host/live/driver/middleware.hpp"

namespace astro::test {

/// A middleware without a wire: a test reads what was published, and says and asks what others would.
class FakeMiddleware : public live::Middleware {
 public:
  struct Topic {
    live::TopicDescription description;
    std::vector<std::pair<std::int64_t, Bytes>> messages;  // time_ns and bytes, since they were last taken
  };

  std::map<std::string, Topic> published;
  std::vector<live::TopicDescription> subscribed;
  std::map<std::string, live::ServiceDescription> services;
  live::ParameterTable* parameters = nullptr;
  bool anybody_listens = true;
  bool types_share_names = false;
  std::function<void(microseconds)> on_wait = [](microseconds) {};
  std::function<void()> on_urgent = [] {};

  std::unique_ptr<live::Publisher> advertise(const live::TopicDescription& topic) override {
    published[topic.name].description = topic;
    return std::make_unique<FakePublisher>(*this, topic.name);
  }
  void subscribe(const live::TopicDescription& topic, OnMessage on_message) override {
    subscribed.push_back(topic);
    subscriptions_.push_back({topic.name, std::string(topic.type.name), std::move(on_message)});
  }
  bool types_may_share_a_name() const override { return types_share_names; }
  void serve(const live::ServiceDescription& service, OnRequest on_request) override {
    services[service.name] = service;
    requests_[service.name] = std::move(on_request);
  }
  void serve_parameters(live::ParameterTable& table) override { parameters = &table; }
  void poll() override {
    for (; !waiting_.empty(); waiting_.pop_front()) waiting_.front()();
    if (std::exchange(fails_, false)) throw Error("the middleware has failed");
  }
  void poll_urgent() override { on_urgent(); }
  void wait(microseconds timeout) override { on_wait(timeout); }

  void fail_at_next_poll() { fails_ = true; }

  /// Another node publishes; the driver gets it at the next poll().
  template <ros2::Message M>
  void say(const std::string& topic, const M& message) {
    say_bytes(topic, M::kType, ros2::encode(message));
  }
  void say_bytes(const std::string& topic, std::string_view type, const Bytes& bytes) {
    bool anybody = false;
    for (const Subscription& each : subscriptions_) {
      if (each.topic != topic || each.type != type) continue;
      anybody = true;
      waiting_.push_back([&each, bytes] { each.on_message(bytes); });
    }
    if (!anybody) throw std::runtime_error("nobody subscribes to " + topic + " as " + std::string(type));
  }

  /// Another node calls; answered at once.
  template <class Service>
  typename Service::Response call(const std::string& service, const typename Service::Request& request = {}) {
    const auto reply = requests_.at(service)(ros2::encode(request));
    return ros2::decode<typename Service::Response>(reply.value()).value();
  }

  /// The messages of a topic since the last call.
  template <ros2::Message M>
  std::vector<M> take(const std::string& topic) {
    Topic& from = published.at(topic);
    if (from.description.type.name != M::kType) throw std::runtime_error(topic + " is of another type");
    std::vector<M> messages;
    for (const auto& [time_ns, bytes] : std::exchange(from.messages, {}))
      messages.push_back(ros2::decode<M>(bytes).value());
    return messages;
  }
  template <ros2::Message M>
  M newest(const std::string& topic) {
    const std::vector<M> all = take<M>(topic);
    if (all.empty()) throw std::runtime_error("nothing was published on " + topic);
    return all.back();
  }

 private:
  struct Subscription {
    std::string topic, type;
    OnMessage on_message;
  };
  class FakePublisher : public live::Publisher {
   public:
    FakePublisher(FakeMiddleware& of, std::string topic) : of_(of), topic_(std::move(topic)) {}
    void publish(ByteView message, std::int64_t time_ns) override {
      of_.published.at(topic_).messages.emplace_back(time_ns, Bytes(message.begin(), message.end()));
    }
    bool has_subscribers() const override { return of_.anybody_listens; }

   private:
    FakeMiddleware& of_;
    std::string topic_;
  };

  std::deque<Subscription> subscriptions_;
  std::map<std::string, OnRequest> requests_;
  std::deque<std::function<void()>> waiting_;
  bool fails_ = false;
};

}  // namespace astro::test
