// A peer on Eclipse CycloneDDS, an implementation of DDS that shares no code with Fast DDS; bytes are read and written by code
// that idlc made. Services are called in the manner of rmw_cyclonedds.
//
//   cyclone_peer DOMAIN [humble|subnet]    humble: ros_discovery_info is read with identifiers of 24 bytes, and the loopback
//                                          interface is used as for ROS_LOCALHOST_ONLY=1; subnet: other computers, too
#include <dds/dds.h>
#include <dds/ddsrt/log.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <list>
#include <map>
#include <stdexcept>

#include "ros2.h"
#include "tests/support/ros2/peers/peer.hpp"
#include "tests/support/ros2/peers/peer_text.hpp"

namespace astro::support {
namespace {

/// As rmw_cyclonedds sets CycloneDDS up for ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST: on a network card, without multicast.
constexpr const char* kLocalhost =
    "<CycloneDDS><Domain><General><AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</"
    "MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"localhost\"/></Peers></Discovery></Domain></CycloneDDS>";
/// As that of Humble does for ROS_LOCALHOST_ONLY=1: on the loopback interface.
constexpr const char* kLocalhostOfHumble =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface "
    "address=\"127.0.0.1\"/></Interfaces></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</"
    "MaxAutoParticipantIndex>"
    "</Discovery></Domain></CycloneDDS>";
/// As rmw_cyclonedds does for SUBNET, the default of ROS 2.
constexpr const char* kSubnet =
    "<CycloneDDS><Domain><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex></Discovery></Domain></CycloneDDS>";
constexpr dds_duration_t kLongest = DDS_SECS(10);
// All replies of a service reach all its clients; those of others must not push out one's own on a busy machine.
constexpr int kDepth = 1000;

/// What goes wrong; but CycloneDDS can read no reply to a client of the other kind, and does without multicast on loopback.
void log(void*, const dds_log_data_t* data) {
  const std::string text(data->message, data->size);
  for (const char* expected : {"deserialization rr/", "not multicast-capable"})
    if (text.find(expected) != std::string::npos) return;
  std::fputs(text.c_str(), stderr);
}

dds_entity_t checked(dds_entity_t entity) {
  if (entity < 0) throw std::runtime_error(dds_strretcode(entity));
  return entity;
}

using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;

Qos qos_of(bool latched, int depth, const std::string& user_data) {
  Qos qos(dds_create_qos(), dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_INFINITY);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  if (latched) dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_writer_data_lifecycle(qos.get(), false);
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &xcdr1);
  dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  return qos;
}

/// The types of Humble and of later distributions have one name.
const dds_topic_descriptor_t& graph_of_humble() {
  const dds_topic_descriptor_t& humble = humble_msg_dds__ParticipantEntitiesInfo__desc;
  static const dds_topic_descriptor_t renamed{
      humble.m_size,
      humble.m_align,
      humble.m_flagset,
      humble.m_nkeys,
      rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc.m_typename,
      humble.m_keys,
      humble.m_nops,
      humble.m_ops,
      humble.m_meta,
      humble.type_information,
      humble.type_mapping,
      humble.restrict_data_representation};
  return renamed;
}

struct Kind {
  const dds_topic_descriptor_t* descriptor;
  std::function<std::string(const void*)> text;
};

template <class T, class Text>
Kind kind(const dds_topic_descriptor_t& descriptor, Text text) {
  return {&descriptor, [text](const void* sample) { return text(*static_cast<const T*>(sample)); }};
}

std::map<std::string, Kind> all_kinds(bool humble) {
  const auto graph = [](const auto& m) { return text_of_graph(m); };
  return {
      {"odometry", kind<nav_msgs_msg_dds__Odometry_>(nav_msgs_msg_dds__Odometry__desc,
                                                     [](const auto& m) { return text_of_odometry(m); })},
      {"transforms", kind<tf2_msgs_msg_dds__TFMessage_>(tf2_msgs_msg_dds__TFMessage__desc,
                                                        [](const auto& m) { return text_of_transforms(m); })},
      {"joints", kind<sensor_msgs_msg_dds__JointState_>(sensor_msgs_msg_dds__JointState__desc,
                                                        [](const auto& m) { return text_of_joints(m); })},
      {"battery", kind<sensor_msgs_msg_dds__BatteryState_>(sensor_msgs_msg_dds__BatteryState__desc,
                                                           [](const auto& m) { return text_of_battery(m); })},
      {"diagnostics",
       kind<diagnostic_msgs_msg_dds__DiagnosticArray_>(diagnostic_msgs_msg_dds__DiagnosticArray__desc,
                                                       [](const auto& m) { return text_of_diagnostics(m); })},
      {"text", kind<std_msgs_msg_dds__String_>(std_msgs_msg_dds__String__desc,
                                               [](const auto& m) { return one_line(m.data); })},
      {"pose", kind<geometry_msgs_msg_dds__PoseStamped_>(geometry_msgs_msg_dds__PoseStamped__desc,
                                                         [](const auto& m) { return text_of_pose(m); })},
      {"event",
       kind<rcl_interfaces_msg_dds__ParameterEvent_>(rcl_interfaces_msg_dds__ParameterEvent__desc,
                                                     [](const auto& m) { return text_of_event(m); })},
      {"graph", humble ? kind<humble_msg_dds__ParticipantEntitiesInfo_>(graph_of_humble(), graph)
                       : kind<rmw_dds_common_msg_dds__ParticipantEntitiesInfo_>(
                             rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc, graph)},
  };
}

/// Of one service: its two endpoints show the same client id.
struct Client {
  dds_entity_t writer, reader;
  std::uint64_t id;
  std::int64_t number = 0;
};

class CyclonePeer : public Peer {
 public:
  CyclonePeer(int domain, bool humble)
      : kinds_(all_kinds(humble)),
        participant_(checked(dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr))) {
  }
  ~CyclonePeer() override { dds_delete(participant_); }

  bool subscribe(const std::string& topic, const std::string& name, bool latched) override {
    const auto found = kinds_.find(name);
    if (found == kinds_.end()) return false;
    const std::string wire_name = name == "graph" ? topic.substr(1) : "rt" + topic;
    const Qos qos = qos_of(latched, 1000, "");
    const dds_entity_t reader = checked(
        dds_create_reader(participant_, topic_of(wire_name, *found->second.descriptor), qos.get(), nullptr));
    subscriptions_.push_back({topic, name, reader, found->second.text});
    return true;
  }

  std::vector<std::string> writers_of(const std::string& topic) override {
    std::vector<std::string> writers;
    for (const Subscription& each : subscriptions_) {
      if (each.topic != topic) continue;
      std::array<dds_instance_handle_t, 100> handles{};
      const dds_return_t count = dds_get_matched_publications(each.reader, handles.data(), handles.size());
      for (dds_return_t i = 0; i < count; ++i) {
        dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(each.reader, handles.at(i));
        if (endpoint == nullptr) continue;
        void* data = nullptr;
        std::size_t size = 0;
        dds_qget_userdata(endpoint->qos, &data, &size);
        writers.push_back(hexadecimal(endpoint->key.v) + ' ' + std::string(static_cast<char*>(data), size));
        dds_free(data);
        dds_builtintopic_free_endpoint(endpoint);
      }
    }
    return writers;
  }

  std::vector<std::string> participants() override {
    std::vector<std::string> shown;
    const dds_entity_t reader =
        checked(dds_create_reader(participant_, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr));
    take_each(reader, [&](const void* sample) {
      void* data = nullptr;
      std::size_t size = 0;
      dds_qget_userdata(static_cast<const dds_builtintopic_participant_t*>(sample)->qos, &data, &size);
      shown.emplace_back(static_cast<char*>(data), size);
      dds_free(data);
      return false;
    });
    dds_delete(reader);
    return shown;
  }

  bool twist(const std::string& topic, double v_mps, double w_radps) override {
    geometry_msgs_msg_dds__Twist_ message{};
    message.linear.x = v_mps;
    message.angular.z = w_radps;
    return publish(topic, geometry_msgs_msg_dds__Twist__desc, &message);
  }
  bool twist_stamped(const std::string& topic, double v_mps, double w_radps, std::int64_t stamp_ns) override {
    std::string frame = "base_link";
    geometry_msgs_msg_dds__TwistStamped_ message{};
    message.header.stamp = {static_cast<std::int32_t>(stamp_ns / 1'000'000'000),
                            static_cast<std::uint32_t>(stamp_ns % 1'000'000'000)};
    message.header.frame_id = frame.data();
    message.twist.linear.x = v_mps;
    message.twist.angular.z = w_radps;
    return publish(topic, geometry_msgs_msg_dds__TwistStamped__desc, &message);
  }
  bool pose(const std::string& topic, const std::string& in_frame, double x_m, double y_m,
            double heading_rad) override {
    std::string frame = in_frame;
    geometry_msgs_msg_dds__PoseWithCovarianceStamped_ message{};
    message.header.frame_id = frame.data();
    message.pose.pose = {{x_m, y_m, 0}, {0, 0, std::sin(heading_rad / 2), std::cos(heading_rad / 2)}};
    return publish(topic, geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc, &message);
  }

  std::optional<Answer> trigger(const std::string& service) override {
    std_srvs_srv_dds__Trigger_Request_ request{};
    return call<std_srvs_srv_dds__Trigger_Response_>(service, std_srvs_srv_dds__Trigger_Request__desc,
                                                     std_srvs_srv_dds__Trigger_Response__desc, request,
                                                     [](const auto& response) {
                                                       return Answer{response.success, response.message};
                                                     });
  }
  std::optional<Answer> set_bool(const std::string& service, bool data) override {
    std_srvs_srv_dds__SetBool_Request_ request{};
    request.data = data;
    return call<std_srvs_srv_dds__SetBool_Response_>(service, std_srvs_srv_dds__SetBool_Request__desc,
                                                     std_srvs_srv_dds__SetBool_Response__desc, request,
                                                     [](const auto& response) {
                                                       return Answer{response.success, response.message};
                                                     });
  }
  std::optional<Answer> get(const std::string& node, const std::string& name) override {
    Text word(name);
    rcl_interfaces_srv_dds__GetParameters_Request_ request{};
    request.names = word.list();
    return call<rcl_interfaces_srv_dds__GetParameters_Response_>(
        node + "/get_parameters", rcl_interfaces_srv_dds__GetParameters_Request__desc,
        rcl_interfaces_srv_dds__GetParameters_Response__desc, request, [](const auto& response) {
          if (response.values._length != 1) return Answer{};
          return Answer{true, text_of_value(response.values._buffer[0])};
        });
  }
  std::optional<Answer> set(const std::string& node, const std::string& name,
                            const std::string& value) override {
    Text name_text(name), value_text(value);
    rcl_interfaces_msg_dds__Parameter_ parameter{};
    parameter.name = name_text.word();
    parameter.value.string_value = value_text.word();
    fill_value(parameter.value, value);
    rcl_interfaces_srv_dds__SetParameters_Request_ request{};
    request.parameters = {1, 1, &parameter, false};
    return call<rcl_interfaces_srv_dds__SetParameters_Response_>(
        node + "/set_parameters", rcl_interfaces_srv_dds__SetParameters_Request__desc,
        rcl_interfaces_srv_dds__SetParameters_Response__desc, request, [](const auto& response) {
          if (response.results._length != 1) return Answer{};
          return Answer{response.results._buffer[0].successful, response.results._buffer[0].reason};
        });
  }
  std::optional<Answer> list(const std::string& node, const std::string& prefix,
                             std::uint64_t depth) override {
    Text word(prefix);
    rcl_interfaces_srv_dds__ListParameters_Request_ request{};
    if (!prefix.empty()) request.prefixes = word.list();
    request.depth = depth;
    return call<rcl_interfaces_srv_dds__ListParameters_Response_>(
        node + "/list_parameters", rcl_interfaces_srv_dds__ListParameters_Request__desc,
        rcl_interfaces_srv_dds__ListParameters_Response__desc, request, [](const auto& response) {
          return Answer{true, words_of(response.result.names)};
        });
  }
  std::optional<Answer> describe(const std::string& node, const std::string& name) override {
    Text word(name);
    rcl_interfaces_srv_dds__DescribeParameters_Request_ request{};
    request.names = word.list();
    return call<rcl_interfaces_srv_dds__DescribeParameters_Response_>(
        node + "/describe_parameters", rcl_interfaces_srv_dds__DescribeParameters_Request__desc,
        rcl_interfaces_srv_dds__DescribeParameters_Response__desc, request, [](const auto& response) {
          if (response.descriptors._length != 1) return Answer{};
          return Answer{true, text_of_descriptor(response.descriptors._buffer[0])};
        });
  }

  void take(const OnSample& got) override {
    for (const Subscription& each : subscriptions_)
      take_each(each.reader, [&](const void* sample) {
        got(each.topic, each.kind, each.text(sample));
        return false;
      });
  }

 private:
  struct Subscription {
    std::string topic, kind;
    dds_entity_t reader;
    std::function<std::string(const void*)> text;
  };

  /// Of a text as C has it, and of a sequence of it alone.
  class Text {
   public:
    explicit Text(std::string text) : text_(std::move(text)) {}
    char* word() { return text_.data(); }
    dds_sequence_string list() { return {1, 1, &word_, false}; }

   private:
    std::string text_;
    char* word_ = text_.data();
  };

  dds_entity_t topic_of(const std::string& name, const dds_topic_descriptor_t& descriptor) {
    dds_entity_t& topic = topics_[{name, descriptor.m_typename}];
    if (topic == 0)
      topic = checked(dds_create_topic(participant_, &descriptor, name.c_str(), nullptr, nullptr));
    return topic;
  }

  bool publish(const std::string& topic, const dds_topic_descriptor_t& descriptor, const void* message) {
    dds_entity_t& writer = writers_[{topic, descriptor.m_typename}];
    const Qos qos = qos_of(false, 10, "");
    if (writer == 0)
      writer =
          checked(dds_create_writer(participant_, topic_of("rt" + topic, descriptor), qos.get(), nullptr));
    return until([&] { return is_read(writer); }) && dds_write(writer, message) == DDS_RETCODE_OK;
  }

  static bool is_read(dds_entity_t writer) {
    dds_publication_matched_status_t status{};
    dds_get_publication_matched_status(writer, &status);
    return status.current_count > 0;
  }
  static bool is_written(dds_entity_t reader) {
    dds_subscription_matched_status_t status{};
    dds_get_subscription_matched_status(reader, &status);
    return status.current_count > 0;
  }
  template <class Condition>
  static bool until(Condition condition) {
    const dds_time_t end = dds_time() + kLongest;
    while (!condition()) {
      if (dds_time() > end) return false;
      dds_sleepfor(DDS_USECS(200));
    }
    return true;
  }

  /// Stops when `each` returns true.
  template <class Each>
  static bool take_each(dds_entity_t reader, Each each) {
    void* sample = nullptr;
    dds_sample_info_t info;
    while (dds_take(reader, &sample, &info, 1, 1) > 0) {
      const bool done = info.valid_data && each(sample);
      dds_return_loan(reader, &sample, 1);
      sample = nullptr;
      if (done) return true;
    }
    return false;
  }

  Client& client_of(const std::string& service, const dds_topic_descriptor_t& request,
                    const dds_topic_descriptor_t& response) {
    const auto found = clients_.find(service);
    if (found != clients_.end()) return found->second;
    const Qos qos = qos_of(false, kDepth, fmt::format("clientid={}.{};", getpid(), clients_.size()));
    Client client{};
    client.writer = checked(
        dds_create_writer(participant_, topic_of("rq" + service + "Request", request), qos.get(), nullptr));
    client.reader = checked(
        dds_create_reader(participant_, topic_of("rr" + service + "Reply", response), qos.get(), nullptr));
    dds_get_instance_handle(client.writer, &client.id);
    return clients_.emplace(service, client).first->second;
  }

  template <class Response, class Request, class Read>
  std::optional<Answer> call(const std::string& service, const dds_topic_descriptor_t& request_type,
                             const dds_topic_descriptor_t& response_type, Request& request, Read read) {
    Client& client = client_of(service, request_type, response_type);
    if (!until([&] { return is_read(client.writer) && is_written(client.reader); })) return std::nullopt;
    request.client = client.id;
    request.number = ++client.number;
    dds_write(client.writer, &request);
    std::optional<Answer> answer;
    until([&] {
      return take_each(client.reader, [&](const void* sample) {
        const auto& response = *static_cast<const Response*>(sample);
        if (response.client != client.id || response.number != client.number) return false;
        answer = read(response);
        return true;
      });
    });
    return answer;
  }

  std::map<std::string, Kind> kinds_;
  dds_entity_t participant_;
  std::map<std::pair<std::string, std::string>, dds_entity_t> topics_, writers_;  // by name and type
  std::list<Subscription> subscriptions_;
  std::map<std::string, Client> clients_;
};

}  // namespace
}  // namespace astro::support

int main(int count, char** arguments) {
  using namespace astro::support;
  if (count < 2) return 2;
  const std::string_view option = count > 2 ? arguments[2] : "";
  const bool humble = option == "humble";
  dds_set_log_sink(log, nullptr);
  setenv("CYCLONEDDS_URI", option == "subnet" ? kSubnet : humble ? kLocalhostOfHumble : kLocalhost, 1);
  CyclonePeer peer(std::atoi(arguments[1]), humble);
  return run(peer);
}
