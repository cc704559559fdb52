#include "host/live/foxglove/foxglove_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "host/live/foxglove/server_messages.hpp"

namespace astro::foxglove {
namespace {

using std::chrono::steady_clock;

/// The period of comparing parameters, because other programs also change them and nobody reports that.
constexpr std::chrono::seconds kComparePeriod{1};
/// After this time a poll() begins no further question, so that a thousand of them do not block the robot's thread.
constexpr std::chrono::milliseconds kShare{2};
enum Rank : int { kUrgent, kMessage, kQuestion, kLater };

std::string new_session_id() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

class FoxglovePublisher : public live::Publisher {
 public:
  FoxglovePublisher(Server& server, std::uint32_t channel, bool latched,
                    std::shared_ptr<std::atomic<int>> subscribers)
      : server_(server), channel_(channel), latched_(latched), subscribers_(std::move(subscribers)) {}

  void publish(ByteView message, std::int64_t time_ns) override {
    if (!has_subscribers()) return;
    auto sample = std::make_shared<const Sample>(Sample{time_ns, Bytes(message.begin(), message.end())});
    auto task = [channel = channel_, sample = std::move(sample)](Hub& hub) { hub.publish(channel, sample); };
    latched_ ? server_.post(std::move(task)) : server_.post_data(std::move(task));
  }
  /// Always true for a latched topic, because somebody may subscribe later.
  bool has_subscribers() const override { return latched_ || *subscribers_ > 0; }

 private:
  Server& server_;
  std::uint32_t channel_;
  bool latched_;
  std::shared_ptr<std::atomic<int>> subscribers_;
};

}  // namespace

FoxgloveServer::FoxgloveServer(Settings settings) : settings_(std::move(settings)) {
  const RequestSink sink = [this](Request request) { requests_.push(std::move(request)); };
  server_ = std::make_unique<Server>(
      settings_.address, settings_.origins,
      std::make_unique<Hub>(settings_.name, new_session_id(), settings_.allow_commands, sink), sink);
}
FoxgloveServer::~FoxgloveServer() = default;

std::unique_ptr<live::Publisher> FoxgloveServer::advertise(const live::TopicDescription& topic) {
  const auto subscribers = std::make_shared<std::atomic<int>>(0);
  Channel channel{++channels_, topic, {}, subscribers};
  server_->post([channel = std::move(channel)](Hub& hub) { hub.add(channel); });
  return std::make_unique<FoxglovePublisher>(*server_, channels_, topic.latched, subscribers);
}

void FoxgloveServer::subscribe(const live::TopicDescription& topic, OnMessage on_message) {
  if (!settings_.allow_commands) return;
  on_message_.push_back(std::move(on_message));
  Inlet inlet{static_cast<std::uint32_t>(on_message_.size()), topic};
  server_->post([inlet = std::move(inlet)](Hub& hub) { hub.add(inlet); });
}

void FoxgloveServer::serve(const live::ServiceDescription& description, OnRequest on_request) {
  const std::vector<std::string>& always = settings_.always_served;
  if (!settings_.allow_commands && std::find(always.begin(), always.end(), description.name) == always.end())
    return;
  on_request_.push_back(std::move(on_request));
  Service service{static_cast<std::uint32_t>(on_request_.size()), description};
  if (description.urgent) urgent_.insert(service.id);
  server_->post([service = std::move(service)](Hub& hub) { hub.add(service); });
}

void FoxgloveServer::serve_parameters(live::ParameterTable& table) {
  table_ = &table;
  server_->post([](Hub& hub) { hub.has_parameters(); });
}

void FoxgloveServer::poll() {
  server_->start();
  answer_waiting();
  if (steady_clock::now() >= compare_at_) tell_changes();
  server_->flush();
}

/// The order of requests: first calls that stop the robot, then messages, because only the newest are kept and none may
/// become stale, then questions. Questions about parameters wait while these are being read.
int FoxgloveServer::rank(const Request& request) {
  if (std::holds_alternative<ParametersAsked>(request) || std::holds_alternative<ParametersGiven>(request))
    return table_ == nullptr || table_->is_fresh() ? kQuestion : kLater;
  if (std::holds_alternative<MessageArrived>(request)) return kMessage;
  const auto* call = std::get_if<CallArrived>(&request);
  return call != nullptr && urgent_.contains(call->service) ? kUrgent : kQuestion;
}

/// Answers only as many requests as wait at its begin, so that the call ends. After kShare it begins no question, because the
/// robot and other middlewares must not wait longer.
void FoxgloveServer::answer_waiting() {
  const auto until = steady_clock::now() + kShare;
  const auto rank_of = [this](const Request& request) { return rank(request); };
  for (std::size_t left = requests_.size(); left > 0; --left) {
    const auto request = requests_.pop(rank_of, steady_clock::now() < until ? kQuestion : kMessage);
    if (!request) return;
    std::visit([this](const auto& each) { take(each); }, *request);
  }
}

void FoxgloveServer::poll_urgent() {
  const auto rank_of = [this](const Request& request) { return rank(request); };
  while (const auto request = requests_.pop(rank_of, kUrgent))
    std::visit([this](const auto& each) { take(each); }, *request);
}

void FoxgloveServer::take(const MessageArrived& arrived) { on_message_[arrived.inlet - 1](arrived.message); }

void FoxgloveServer::take(const CallArrived& arrived) {
  const std::optional<Bytes> response = on_request_[arrived.service - 1](arrived.request);
  server_->post([=, client = arrived.client, service = arrived.service, call = arrived.call](Hub& hub) {
    if (response)
      hub.answer_binary(client, service_response(service, call, *response));
    else
      hub.answer_text(client,
                      service_call_failure(service, call, "these bytes are no request of this service"));
  });
}

std::vector<ros2::msg::Parameter> FoxgloveServer::values_of(std::vector<std::string> names) {
  if (table_ == nullptr) return {};
  if (names.empty())
    for (const ros2::msg::ParameterDescriptor& each : table_->descriptors()) names.push_back(each.name);
  std::vector<ros2::msg::Parameter> parameters;
  for (const std::string& name : names)
    if (const auto value = table_->value(name)) parameters.push_back({name, *value});
  return parameters;
}

void FoxgloveServer::take(const ParametersAsked& asked) {
  server_->post([client = asked.client, text = parameter_values(values_of(asked.what.names), asked.what.id)](
                    Hub& hub) { hub.answer_text(client, text); });
}

/// Sets the parameters; "" if that was done, otherwise why not.
std::string FoxgloveServer::refusal_of(std::span<const ros2::msg::Parameter> parameters) {
  if (table_ == nullptr) return "there are no parameters";
  if (!settings_.allow_commands) return "viewers may not change parameters here";
  const ros2::msg::SetParametersResult result = table_->set(parameters);
  return result.successful ? "" : result.reason;
}

void FoxgloveServer::take(const ParametersGiven& given) {
  const std::string refusal = refusal_of(given.what.parameters);
  std::vector<std::string> names;
  for (const ros2::msg::Parameter& each : given.what.parameters) names.push_back(each.name);
  // The values are sent also after a refusal, because until then the viewer shows what it tried to set.
  std::string values =
      parameter_values(names.empty() ? std::vector<ros2::msg::Parameter>{} : values_of(names), given.what.id);
  server_->post([client = given.client, refusal, values = std::move(values)](Hub& hub) {
    if (!refusal.empty()) hub.tell(client, status(Level::error, refusal));
    hub.answer_text(client, values);
  });
  tell_changes();
}

void FoxgloveServer::take(const NoticeArrived& arrived) { settings_.notice(arrived.remark); }

void FoxgloveServer::tell_changes() {
  if (table_ == nullptr || (*watched_ && !table_->is_fresh())) return;
  compare_at_ = steady_clock::now() + kComparePeriod;
  // Only the server's thread knows whether anybody watches. It is asked now, and the next call sees the answer.
  server_->post([watched = watched_](Hub& hub) { *watched = hub.parameters_are_watched(); });
  if (!*watched_) return told_.clear();
  std::vector<ros2::msg::Parameter> changed;
  for (ros2::msg::Parameter& each : values_of({})) {
    const auto [told, is_new] = told_.try_emplace(each.name, each.value);
    if (!is_new && told->second == each.value) continue;
    told->second = each.value;
    changed.push_back(std::move(each));
  }
  if (changed.empty()) return;
  server_->post([changed = std::move(changed)](Hub& hub) { hub.parameters_changed(changed); });
}

}  // namespace astro::foxglove
