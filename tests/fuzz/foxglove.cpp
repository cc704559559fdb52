// What a viewer sends over a WebSocket: messages, each after its length (u16) and a byte that says whether it is text.
#include <algorithm>

#include "host/formats/messages/geometry.hpp"
#include "host/formats/messages/std.hpp"
#include "host/live/foxglove/hub.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {
namespace {

using namespace live;      // NOLINT(google-build-using-namespace): this file is all of it
using namespace ros2;      // NOLINT(google-build-using-namespace): this file is all of it
using namespace foxglove;  // NOLINT(google-build-using-namespace)

Bytes message(bool is_text, std::string_view content) {
  Bytes bytes;
  append(bytes, static_cast<std::uint16_t>(content.size()));
  bytes.push_back(is_text ? 1 : 0);
  append(bytes, as_bytes(content));
  return bytes;
}

}  // namespace

void take(ByteView input) {
  const auto subscribers = std::make_shared<std::atomic<int>>(0);
  std::size_t asked = 0;
  {
    Hub hub("robot", "s", true, [&](const Request&) { ++asked; });
    hub.add(Channel{1, {"/odom", message_type<msg::String>()}, {}, subscribers});
    TopicDescription latched{"/model", message_type<msg::String>()};
    latched.latched = true;
    hub.add(Channel{2, latched, {}, subscribers});
    hub.add(Inlet{1, {"/cmd_vel", message_type<msg::Twist>()}});
    hub.add(Service{1,
                    {"/stop", msg::Trigger::kType, message_type<msg::Trigger::Request>(),
                     message_type<msg::Trigger::Response>()}});
    hub.publish(2, std::make_shared<const Sample>());
    Session& session = hub.join();
    ByteCursor in(input);
    while (in.left() > 0 && in.ok()) {
      const auto size = in.number<std::uint16_t>();
      const bool is_text = in.number<std::uint8_t>() != 0;
      session.receive(is_text, in.take(std::min<std::size_t>(size, in.left())));
      hub.publish(1, std::make_shared<const Sample>());
      require(*subscribers >= 0 && *subscribers <= 2, "a channel is subscribed once");
    }
    hub.report();
    require(asked <= input.size(), "no message asks for more than it has bytes");
    while (session.queue().pop()) continue;
    require(session.queue().empty(), "all that waits can be sent");
  }
  require(*subscribers == 0, "who has left subscribes to nothing");
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  for (
      const char* text :
      {R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1},{"id":2,"channelId":2}]})",
       R"({"op":"unsubscribe","subscriptionIds":[1]})",
       R"({"op":"advertise","channels":[{"id":5,"topic":"/cmd_vel","encoding":"cdr","schemaName":"geometry_msgs/msg/Twist"}]})",
       R"({"op":"unadvertise","channelIds":[5]})",
       R"({"op":"getParameters","parameterNames":["b"],"id":"q"})",
       R"({"op":"setParameters","parameters":[{"name":"b","value":1,"type":"float64"}]})",
       R"({"op":"subscribeParameterUpdates","parameterNames":[]})", R"({"op":"subscribeConnectionGraph"})"})
    all.push_back(message(true, text));
  all.push_back(message(false, std::string_view("\x01\x05\0\0\0\0\x01\0\0", 9)));
  all.push_back(message(false, std::string_view("\x02\x01\0\0\0\x09\0\0\0\x03\0\0\0cdr\0\x01\0\0\0", 21)));
  Bytes together;
  for (const Bytes& each : all) append(together, ByteView(each));
  all.push_back(together);
  return all;
}

}  // namespace astro::fuzz
