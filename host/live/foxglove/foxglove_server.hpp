#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "host/live/driver/middleware.hpp"
#include "host/live/foxglove/request_queue.hpp"
#include "host/live/foxglove/server.hpp"

namespace astro::foxglove {

struct Settings {
  std::string name;  // of the robot, for people
  Address address{"127.0.0.1", 8765};
  std::vector<std::string> origins{};  // of web pages that may connect, besides the usual ones (origin.hpp)
  /// Whether viewers may publish, call any service and set parameters. Otherwise they may look, and call `always_served`.
  bool allow_commands = false;
  std::vector<std::string> always_served{};  // names of services: those that stop the robot
  /// Who came, went and was refused; called inside poll().
  std::function<void(const Remark&)> notice = [](const Remark&) {};
};

/// The middleware for viewers that speak the Foxglove WebSocket protocol. It serves them from the first poll() on, so that they
/// find everything that was advertised before.
///
/// Topics are carried as they are, CDR with the definition in text; their reliability makes no difference, because a client that
/// reads too slowly loses the oldest messages of topics that are not latched (ClientQueue).
class FoxgloveServer : public live::Middleware {
 public:
  /// Throws astro::Error if the address cannot be had.
  explicit FoxgloveServer(Settings settings);
  ~FoxgloveServer() override;

  std::uint16_t port() const { return server_->port(); }

  std::unique_ptr<live::Publisher> advertise(const live::TopicDescription& topic) override;
  /// Nothing comes if commands are not allowed.
  void subscribe(const live::TopicDescription& topic, OnMessage on_message) override;
  /// True, because of these topics a viewer sees only what it sends itself.
  bool types_may_share_a_name() const override { return true; }
  /// Not offered if commands are not allowed, unless it is one of `always_served`.
  void serve(const live::ServiceDescription& service, OnRequest on_request) override;
  void serve_parameters(live::ParameterTable& table) override;
  void poll() override;
  void poll_urgent() override;
  void wait(std::chrono::microseconds timeout) override { requests_.wait(timeout); }

 private:
  int rank(const Request& request);
  void answer_waiting();
  void take(const MessageArrived& arrived);
  void take(const CallArrived& arrived);
  void take(const ParametersAsked& asked);
  void take(const ParametersGiven& given);
  void take(const NoticeArrived& arrived);
  std::vector<ros2::msg::Parameter> values_of(std::vector<std::string> names);
  std::string refusal_of(std::span<const ros2::msg::Parameter> parameters);
  void tell_changes();

  Settings settings_;
  RequestQueue requests_;
  std::vector<OnMessage> on_message_;  // by inlet, from 1
  std::vector<OnRequest> on_request_;  // by service, from 1
  std::set<std::uint32_t> urgent_;     // services
  std::uint32_t channels_ = 0;
  live::ParameterTable* table_ = nullptr;
  std::map<std::string, ros2::msg::ParameterValue> told_;  // the values that viewers were told last
  std::chrono::steady_clock::time_point compare_at_{};
  std::shared_ptr<std::atomic<bool>> watched_ = std::make_shared<std::atomic<bool>>(false);
  std::unique_ptr<Server> server_;  // last: its thread uses the others
};

}  // namespace astro::foxglove
