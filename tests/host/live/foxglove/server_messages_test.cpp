#include "host/live/foxglove/server_messages.hpp"

#include <gmock/gmock.h>

#include "host/formats/messages/std.hpp"
#include "tests/support/base/json.hpp"

namespace astro::foxglove {
namespace {

using support::parse_json;

Catalogue small_catalogue() {
  Catalogue catalogue;
  catalogue.name = "robot";
  catalogue.session_id = "s1";
  catalogue.channels.push_back({1, {"/text", live::message_type<ros2::msg::String>()}, {}, nullptr});
  catalogue.services.push_back(
      {1,
       {"/stop", ros2::msg::Trigger::kType, live::message_type<ros2::msg::Trigger::Request>(),
        live::message_type<ros2::msg::Trigger::Response>()}});
  return catalogue;
}

TEST(ServerMessages, TheInformationNamesWhatIsOffered) {
  Catalogue catalogue = small_catalogue();
  EXPECT_EQ(parse_json(server_info(catalogue)), parse_json(R"({"op":"serverInfo","name":"robot",
    "capabilities":["services","connectionGraph"],"supportedEncodings":["cdr"],"metadata":{},"sessionId":"s1"})"));
  catalogue.takes_messages = catalogue.has_parameters = true;
  EXPECT_EQ(
      parse_json(server_info(catalogue))["capabilities"],
      parse_json(R"(["services","connectionGraph","clientPublish","parameters","parametersSubscribe"])"));
}

TEST(ServerMessages, ChannelsAndServicesCarryTheirDefinitions) {
  const Catalogue catalogue = small_catalogue();
  EXPECT_EQ(parse_json(advertise(catalogue.channels)),
            parse_json(R"({"op":"advertise","channels":[{"id":1,"topic":"/text","encoding":"cdr",
    "schemaName":"std_msgs/msg/String","schemaEncoding":"ros2msg","schema":"string data\n"}]})"));
  const auto services = parse_json(advertise_services(catalogue.services))["services"];
  ASSERT_EQ(services.size(), 1U);
  EXPECT_EQ(services[0]["name"], "/stop");
  EXPECT_EQ(services[0]["type"], "std_srvs/srv/Trigger");
  EXPECT_EQ(services[0]["request"]["schemaName"], "std_srvs/srv/Trigger_Request");
  EXPECT_EQ(services[0]["response"]["schema"], "bool success\nstring message\n");
}

TEST(ServerMessages, BinaryFramesAreAsPublished) {
  EXPECT_EQ(data_header(0x01020304, 0x1122334455667788),
            std::string("\x01\x04\x03\x02\x01\x88\x77\x66\x55\x44\x33\x22\x11", 13));
  EXPECT_EQ(service_response(7, 9, Bytes{0, 1, 0, 0, 5}),
            std::string("\x03\x07\0\0\0\x09\0\0\0\x03\0\0\0cdr\0\x01\0\0\x05", 21));
}

TEST(ServerMessages, ParametersCarryTheirTypeWhereJsonHasNone) {
  ros2::msg::Parameter real{"b", {}}, flag{"on", {}}, unset{"none", {}};
  real.value.type = 3;
  real.value.double_value = 2;
  flag.value.type = 1;
  flag.value.bool_value = true;
  const std::vector<ros2::msg::Parameter> all{real, flag, unset};
  EXPECT_EQ(parse_json(parameter_values(all, "q")),
            parse_json(R"({"op":"parameterValues","id":"q","parameters":[
    {"name":"b","value":2.0,"type":"float64"},{"name":"on","value":true},{"name":"none"}]})"));
}

TEST(ServerMessages, TextThatIsNoUtf8IsRepaired) {
  EXPECT_EQ(parse_json(status(Level::error, "a\xFFz"))["message"], "a\xEF\xBF\xBDz");
}

TEST(ServerMessages, OfTheGraphOnlyChangesAreSent) {
  ConnectionGraph before, after;
  before.published["/odom"] = {"robot"};
  before.published["/gone"] = {"robot"};
  before.subscribed["/odom"] = {"viewer 1"};
  before.services["/old"] = {"robot"};
  after.published["/odom"] = {"robot"};
  after.published["/new"] = {"robot"};
  after.subscribed["/odom"] = {"viewer 1", "viewer 2"};
  EXPECT_EQ(parse_json(graph_update(before, after)), parse_json(R"({"op":"connectionGraphUpdate",
    "publishedTopics":[{"name":"/new","publisherIds":["robot"]}],
    "subscribedTopics":[{"name":"/odom","subscriberIds":["viewer 1","viewer 2"]}],
    "advertisedServices":[],"removedTopics":["/gone"],"removedServices":["/old"]})"));
}

TEST(ServerMessages, WhenTheLastSubscriberGoesTheEntryOfThatSideIsEmptied) {
  ConnectionGraph before, after;
  before.published["/odom"] = after.published["/odom"] = {"robot"};
  before.subscribed["/odom"] = {"viewer 1"};
  const auto update = parse_json(graph_update(before, after));
  EXPECT_EQ(update["subscribedTopics"], parse_json(R"([{"name":"/odom","subscriberIds":[]}])"));
  EXPECT_EQ(update["removedTopics"], parse_json("[]"));
}

}  // namespace
}  // namespace astro::foxglove
