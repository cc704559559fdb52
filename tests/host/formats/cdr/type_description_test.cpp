#include "host/formats/cdr/type_description.hpp"
#include "host/formats/cdr/type_hash.hpp"

#include <gmock/gmock.h>

#include "tests/host/formats/messages/messages.hpp"

namespace astro::ros2 {
namespace {

template <class M>
void expect_hash(const std::string& published) {
  EXPECT_EQ(hash_of<M>(), "RIHS01_" + published) << M::kType;
}

// Values that ROS 2 Jazzy prints for its own types, or that other programs have copied from there.
TEST(TypeHash, OfEachMessageIsThatOfRos2) {
  expect_hash<msg::String>("df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  expect_hash<msg::Header>("f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01");
  expect_hash<msg::Vector3>("cc12fe83e4c02719f1ce8070bfd14aecd40f75a96696a67a2a1f37f7dbb0765d");
  expect_hash<msg::PoseStamped>("10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8");
  expect_hash<msg::PoseWithCovarianceStamped>(
      "26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e");
  expect_hash<msg::Twist>("9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a");
  expect_hash<msg::TwistStamped>("5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64");
  expect_hash<msg::TransformStamped>("0a241f87d04668d94099cbb5ba11691d5ad32c2f29682e4eb5653424bd275206");
  expect_hash<msg::TFMessage>("e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087");
  expect_hash<msg::Odometry>("3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
  expect_hash<msg::JointState>("a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e");
  expect_hash<msg::LaserScan>("64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828");
  expect_hash<msg::Imu>("7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b");
  expect_hash<msg::BatteryState>("4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741");
  expect_hash<msg::DiagnosticArray>("5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e");
  expect_hash<msg::DiagnosticStatus>("b0e3e692ea2d54a8af2f4ef1930e81556a2db55216b771f8a7d2724ed47bf0e4");
  expect_hash<msg::Clock>("692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564");
  expect_hash<msg::Log>("e28ce254ca8abc06abf92773b74602cdbf116ed34fbaf294fb9f81da9f318eac");
  expect_hash<msg::ParameterEvent>("043e627780fcad87a22d225bc2a037361dba713fca6a6b9f4b869a5aa0393204");
  expect_hash<msg::ParticipantEntitiesInfo<16>>(
      "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e");
  expect_hash<msg::Trigger::Request>("d010825374ce8918e72bfd826c82603e60f45419e932ea976f807b74a863a199");
  expect_hash<msg::Trigger::Response>("2d946c21e2fc3f1e9ca6986a8191d85fcc70097a8bb7771a053564bc47009cdf");
  expect_hash<msg::SetBool::Request>("c62fbb99d94e1b25e8ef9e109f9581956bb1b3361a45a4e5810c36a90d29932e");
  expect_hash<msg::SetBool::Response>("d0814e7f7b4880ab77e9c57426c7aa1562ab69f11eef8e2e968812f9cbd0b059");
  expect_hash<msg::GetParameters::Request>(
      "135a9e1c3d7cebef792f6687d7ddf99949b21a0bd9a320d863a9110a3f5cf4d6");
}

/// service_msgs/msg/ServiceEventInfo, which is part of the type of each service and of nothing that this node sends.
struct ServiceEventInfo {
  std::uint8_t event_type = 0;
  msg::Time stamp;
  std::array<std::uint8_t, 16> client_gid{};
  std::int64_t sequence_number = 0;

  static constexpr std::string_view kType = "service_msgs/msg/ServiceEventInfo";
  static constexpr std::tuple kFields{Field{&ServiceEventInfo::event_type, "event_type"},
                                      Field{&ServiceEventInfo::stamp, "stamp"},
                                      Field{&ServiceEventInfo::client_gid, "client_gid"},
                                      Field{&ServiceEventInfo::sequence_number, "sequence_number"}};
};

/// The type of a whole service: its request, its response, and the event that tells of a call.
template <class Service>
TypeDescription service_type() {
  const std::string name(Service::kType);
  const FieldType request = single_type<typename Service::Request>(),
                  response = single_type<typename Service::Response>();
  const auto at_most_one = [](FieldType type) {
    type.shape = Shape::bounded_sequence;
    type.capacity = 1;
    return type;
  };
  TypeDescription service{name,
                          {{"request_message", request},
                           {"response_message", response},
                           {"event_message", {kNested, Shape::single, 0, 0, name + "_Event"}}},
                          {}};
  refer_to<ServiceEventInfo>(service.referred);
  refer_to<typename Service::Request>(service.referred);
  refer_to<typename Service::Response>(service.referred);
  service.referred[name + "_Event"] = {name + "_Event",
                                       {{"info", single_type<ServiceEventInfo>()},
                                        {"request", at_most_one(request)},
                                        {"response", at_most_one(response)}},
                                       {}};
  return service;
}

template <class Service>
void expect_service(const std::string& published) {
  EXPECT_EQ(hash_of(service_type<Service>()), "RIHS01_" + published) << Service::kType;
}

TEST(TypeHash, OfEachServiceIsThatOfRos2AndSoAreItsParts) {
  expect_service<msg::Trigger>("eeff2cd6fa5ad9d27cdf4dec64818317839b62f212a91e6b5304b634b2062c5f");
  expect_service<msg::SetBool>("abe9e4bb6b41b40e6789712c00ec8871923e089af3f667a79992a428cff2da0a");
  expect_service<msg::GetParameters>("bf9803d5c74cf989a5de3e0c2e99444599a627c7ff75f97b8c05b01003675cbc");
  expect_service<msg::GetParameterTypes>("da199c878688b3e530bdfe3ca8f74cb9fa0c303101e980a9e8f260e25e1c80ca");
  expect_service<msg::SetParameters>("56eed9a67e169f9cb6c1f987bc88f868c14a8fc9f743a263bc734c154015d7e0");
  expect_service<msg::SetParametersAtomically>(
      "0e192ef259c07fc3c07a13191d27002222e65e00ccec653ca05e856f79285fcd");
  expect_service<msg::ListParameters>("3e6062bfbb27bfb8730d4cef2558221f51a11646d78e7bb30a1e83afac3aad9d");
  expect_service<msg::DescribeParameters>("845b484d71eb0673dae682f2e3ba3c4851a65a3dcfb97bddd82c5b57e91e4cff");
}

TEST(TypeHash, OfTheLongIdentifiersOfHumbleIsAnother) {
  EXPECT_NE(hash_of<msg::ParticipantEntitiesInfo<24>>(), hash_of<msg::ParticipantEntitiesInfo<16>>())
      << "but Humble, which has the longer one, knows no hashes";
}

TEST(Definition, HasTheFieldsAndBehindARuleThoseOfEachReferredMessageOnce) {
  EXPECT_EQ(definition_of<msg::TwistStamped>(),
            "std_msgs/Header header\n"
            "geometry_msgs/Twist twist\n"
            "================================================================================\n"
            "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
            "================================================================================\n"
            "MSG: geometry_msgs/Twist\ngeometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"
            "================================================================================\n"
            "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n"
            "================================================================================\n"
            "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n");
}

TEST(Definition, WritesTheShapesOfFieldsAsRos2Does) {
  EXPECT_THAT(definition_of<msg::PoseWithCovariance>(), testing::HasSubstr("float64[36] covariance\n"));
  EXPECT_THAT(definition_of<msg::BatteryState>(), testing::HasSubstr("float32[] cell_voltage\n"));
  EXPECT_THAT(definition_of<msg::DiagnosticStatus>(), testing::StartsWith("byte level\n"));
  EXPECT_THAT(definition_of<msg::ParameterDescriptor>(),
              testing::HasSubstr("rcl_interfaces/FloatingPointRange[<=1] floating_point_range\n"));
  EXPECT_THAT(definition_of<msg::NodeEntitiesInfo<16>>(),
              testing::StartsWith("string<=256 node_namespace\n"));
  EXPECT_THAT(definition_of<msg::Log>(), testing::HasSubstr("\nuint8 level\n"));
  EXPECT_THAT(definition_of<msg::SetBool::Request>(), testing::StrEq("bool data\n"));
}

TEST(DdsTypeName, IsThatOfTheMiddlewaresOfRos2) {
  EXPECT_EQ(dds_type_name(msg::Odometry::kType), "nav_msgs::msg::dds_::Odometry_");
  EXPECT_EQ(dds_type_name(msg::Trigger::Request::kType), "std_srvs::srv::dds_::Trigger_Request_");
}

TEST(DdsTypeName, OnTheWireLeadsBackToTheMessage) {
  for (const std::string_view type : {msg::Odometry::kType, msg::PoseStamped::kType, msg::TFMessage::kType})
    EXPECT_EQ(ros_type_name(dds_type_name(type)), type);
  for (const char* other : {"", "_", "::msg::dds_::A_", "a::msg::dds_::_", "a::msg::dds_::",
                            "a::msg::dds_::A", "std_srvs::srv::dds_::Trigger_Request_", "Odometry"})
    EXPECT_EQ(ros_type_name(other), std::nullopt) << other;
}

}  // namespace
}  // namespace astro::ros2
