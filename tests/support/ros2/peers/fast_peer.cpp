// A peer on Fast DDS. Services are called in the manner of rmw_fastrtps: the message alone, and beside it which reader waits for
// the reply.
//
//   fast_peer DOMAIN [humble|subnet]    humble: ros_discovery_info is read with identifiers of 24 bytes; subnet: other computers,
//                                       too
#include <poll.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <list>
#include <map>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/cdr/type_description.hpp"
#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/nodes.hpp"
#include "host/formats/messages/parameters.hpp"
#include "host/formats/messages/sensors.hpp"
#include "host/formats/messages/std.hpp"
#include "tests/support/ros2/peers/peer.hpp"
#include "tests/support/ros2/peers/peer_text.hpp"
#include "tests/support/ros2/peers/stock_participant.hpp"

namespace astro::support {
namespace {

using namespace ros2;
using std::chrono::steady_clock;

// All replies of a service reach all its clients; those of others must not push out one's own on a busy machine.
constexpr dds::Qos kClientQos{.depth = 1000};
constexpr auto kLongest = std::chrono::seconds(10);

template <class Condition>
bool until(Condition condition) {
  const auto end = steady_clock::now() + kLongest;
  while (!condition()) {
    if (steady_clock::now() > end) return false;
    poll(nullptr, 0, 1);
  }
  return true;
}

struct Kind {
  std::string_view type;
  std::function<std::string(ByteView)> text;
};

template <Message M, class Text>
Kind kind(Text text) {
  return {M::kType, [text](ByteView bytes) {
            const auto message = decode<M>(bytes);
            return message ? text(*message) : std::string("is not to be decoded");
          }};
}

std::map<std::string, Kind> all_kinds(bool humble) {
  const auto graph = [](const auto& m) { return text_of_graph(m); };
  return {
      {"odometry", kind<msg::Odometry>([](const auto& m) { return text_of_odometry(m); })},
      {"transforms", kind<msg::TFMessage>([](const auto& m) { return text_of_transforms(m); })},
      {"joints", kind<msg::JointState>([](const auto& m) { return text_of_joints(m); })},
      {"battery", kind<msg::BatteryState>([](const auto& m) { return text_of_battery(m); })},
      {"diagnostics", kind<msg::DiagnosticArray>([](const auto& m) { return text_of_diagnostics(m); })},
      {"text", kind<msg::String>([](const auto& m) { return one_line(m.data); })},
      {"pose", kind<msg::PoseStamped>([](const auto& m) { return text_of_pose(m); })},
      {"event", kind<msg::ParameterEvent>([](const auto& m) { return text_of_event(m); })},
      {"graph", humble ? kind<msg::ParticipantEntitiesInfo<msg::kGidBytesOfHumble>>(graph)
                       : kind<msg::ParticipantEntitiesInfo<msg::kGidBytes>>(graph)},
  };
}

class FastPeer : public Peer {
 public:
  FastPeer(int domain, std::string_view option)
      : kinds_(all_kinds(option == "humble")),
        participant_(open_stock_participant(domain, option == "subnet")) {}

  bool subscribe(const std::string& topic, const std::string& name, bool latched) override {
    const auto found = kinds_.find(name);
    if (found == kinds_.end()) return false;
    const std::string wire_name = name == "graph" ? topic.substr(1) : "rt" + topic;
    subscriptions_.push_back(
        {topic, name,
         participant_->create_reader({wire_name, dds_type_name(found->second.type), {true, latched, 1000}}),
         found->second.text});
    return true;
  }
  std::vector<std::string> writers_of(const std::string& topic) override {
    std::vector<std::string> writers;
    for (const Subscription& each : subscriptions_)
      if (each.topic == topic)
        for (const dds::Guid& writer : each.reader->writers())
          writers.push_back(hexadecimal(writer.bytes) + ' ' + participant_->user_data_of(writer));
    return writers;
  }

  bool twist(const std::string& topic, double v_mps, double w_radps) override {
    return publish(topic, msg::Twist{{v_mps, 0, 0}, {0, 0, w_radps}});
  }
  bool twist_stamped(const std::string& topic, double v_mps, double w_radps, std::int64_t stamp_ns) override {
    return publish(
        topic, msg::TwistStamped{{msg::to_time(stamp_ns), "base_link"}, {{v_mps, 0, 0}, {0, 0, w_radps}}});
  }
  bool pose(const std::string& topic, const std::string& frame, double x_m, double y_m,
            double heading_rad) override {
    msg::PoseWithCovarianceStamped message;
    message.header.frame_id = frame;
    message.pose.pose = {{x_m, y_m, 0}, {0, 0, std::sin(heading_rad / 2), std::cos(heading_rad / 2)}};
    return publish(topic, message);
  }

  std::optional<Answer> trigger(const std::string& service) override {
    return call<msg::Trigger>(service, {}, [](const auto& r) { return Answer{r.success, r.message}; });
  }
  std::optional<Answer> set_bool(const std::string& service, bool data) override {
    return call<msg::SetBool>(service, {data}, [](const auto& r) { return Answer{r.success, r.message}; });
  }
  std::optional<Answer> get(const std::string& node, const std::string& name) override {
    return call<msg::GetParameters>(node + "/get_parameters", {{name}}, [](const auto& r) {
      return r.values.size() == 1 ? Answer{true, text_of_value(r.values[0])} : Answer{};
    });
  }
  std::optional<Answer> set(const std::string& node, const std::string& name,
                            const std::string& value) override {
    msg::Parameter parameter{name, {}};
    parameter.value.string_value = value;
    fill_value(parameter.value, value);
    return call<msg::SetParameters>(node + "/set_parameters", {{parameter}}, [](const auto& r) {
      return r.results.size() == 1 ? Answer{r.results[0].successful, r.results[0].reason} : Answer{};
    });
  }
  std::optional<Answer> list(const std::string& node, const std::string& prefix,
                             std::uint64_t depth) override {
    msg::ListParameters::Request request{{}, depth};
    if (!prefix.empty()) request.prefixes.push_back(prefix);
    return call<msg::ListParameters>(node + "/list_parameters", request, [](const auto& r) {
      return Answer{true, words_of(r.result.names)};
    });
  }
  std::optional<Answer> describe(const std::string& node, const std::string& name) override {
    return call<msg::DescribeParameters>(node + "/describe_parameters", {{name}}, [](const auto& r) {
      return r.descriptors.size() == 1 ? Answer{true, text_of_descriptor(r.descriptors[0])} : Answer{};
    });
  }

  void take(const OnSample& got) override {
    for (const Subscription& each : subscriptions_)
      for (const dds::Sample& sample : each.reader->take())
        got(each.topic, each.kind, each.text(sample.payload));
  }

 private:
  struct Subscription {
    std::string topic, kind;
    std::unique_ptr<dds::Reader> reader;
    std::function<std::string(ByteView)> text;
  };
  struct Client {
    std::unique_ptr<dds::Writer> writer;
    std::unique_ptr<dds::Reader> reader;
    std::int64_t number = 0;
  };

  template <Message M>
  bool publish(const std::string& topic, const M& message) {
    std::unique_ptr<dds::Writer>& writer = writers_[{topic, M::kType}];
    if (!writer) writer = participant_->create_writer({"rt" + topic, dds_type_name(M::kType)});
    if (!until([&] { return !writer->certain_readers().empty(); })) return false;
    writer->write(encode(message));
    return true;
  }

  template <class Service, class Read>
  std::optional<Answer> call(const std::string& service, const typename Service::Request& request,
                             Read read) {
    constexpr std::int64_t kUnknown = -(std::int64_t{1} << 32);  // SEQUENCENUMBER_UNKNOWN
    Client& client = clients_[service];
    if (!client.writer) {
      client.writer = participant_->create_writer(
          {"rq" + service + "Request", dds_type_name(Service::Request::kType), kClientQos});
      client.reader = participant_->create_reader(
          {"rr" + service + "Reply", dds_type_name(Service::Response::kType), kClientQos});
    }
    if (!until(
            [&] { return !client.writer->certain_readers().empty() && !client.reader->writers().empty(); }))
      return std::nullopt;
    client.writer->write(encode(request), {client.reader->guid(), kUnknown});
    const dds::SampleId id{client.reader->guid(), ++client.number};
    std::optional<Answer> answer;
    until([&] {
      for (const dds::Sample& sample : client.reader->take())
        if (sample.related == id)
          if (const auto response = decode<typename Service::Response>(sample.payload))
            answer = read(*response);
      return answer.has_value();
    });
    return answer;
  }

  std::map<std::string, Kind> kinds_;
  std::unique_ptr<dds::Participant> participant_;
  std::map<std::pair<std::string, std::string_view>, std::unique_ptr<dds::Writer>>
      writers_;  // by name and type
  std::list<Subscription> subscriptions_;
  std::map<std::string, Client> clients_;
};

}  // namespace
}  // namespace astro::support

int main(int count, char** arguments) {
  if (count < 2) return 2;
  astro::support::FastPeer peer(std::atoi(arguments[1]), count > 2 ? arguments[2] : "");
  return astro::support::run(peer);
}
