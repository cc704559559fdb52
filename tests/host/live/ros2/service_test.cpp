#include "host/live/ros2/service.hpp"

#include <gmock/gmock.h>

#include "host/formats/cdr/codec.hpp"
#include "host/formats/messages/std.hpp"
#include "tests/host/live/ros2/fake_participant.hpp"

namespace astro::live {
namespace {

using dds::guid_of;
using ros2::msg::SetBool;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

const ServiceDescription kDescription{"/enable", SetBool::kType, message_type<SetBool::Request>(),
                                      message_type<SetBool::Response>()};
constexpr Service::Clock::time_point kNow{};

/// A service that repeats what it is told, and a client of each kind.
class ServiceOnAFakeWire : public testing::Test {
 protected:
  std::optional<Bytes> respond(ByteView bytes) {
    const auto request = ros2::decode<SetBool::Request>(bytes);
    if (!request) return std::nullopt;
    ++requests_;
    return ros2::encode(SetBool::Response{request->data, request->data ? "on" : "off"});
  }
  /// In the manner of rmw_fastrtps.
  void fast_request(bool data, std::int64_t number) {
    in().waiting.push_back(
        {ros2::encode(SetBool::Request{data}), {fast_writer_, number}, dds::SampleId{fast_reader_, -1}});
  }
  /// In the manner of rmw_cyclonedds.
  void cyclone_request(bool data, std::uint64_t client, std::int64_t number) {
    ros2::CdrWriter out;
    out.number(client);
    out.number(number);
    out.number(static_cast<std::uint8_t>(data));
    in().waiting.push_back({out.bytes(), {cyclone_writer_, number}, std::nullopt});
  }
  void find(const dds::Guid& reader) { out().readers.push_back(reader); }
  dds::FakeWire::ReaderEnd& in() { return wire_.reader_of("rq/enableRequest"); }
  dds::FakeWire::WriterEnd& out() { return wire_.writer_of("rr/enableReply"); }

  const dds::Guid fast_writer_ = guid_of(0x71, 3), fast_reader_ = guid_of(0x72, 4);
  const dds::Guid cyclone_writer_ = guid_of(0x81, 3), cyclone_reader_ = guid_of(0x82, 4);
  dds::FakeWire wire_{
      {}, {}, {{cyclone_writer_, "clientid=1.2;"}, {cyclone_reader_, "clientid=1.2;typehash=x;"}}};
  dds::FakeParticipant participant_{wire_};
  int requests_ = 0;
  Service service_{participant_, kDescription, "7", [this](ByteView bytes) { return respond(bytes); }};
};

Bytes cyclone_response(std::uint64_t client, std::int64_t number, const SetBool::Response& response) {
  ros2::CdrWriter out;
  out.number(client);
  out.number(number);
  put(out, response);
  return out.bytes();
}

TEST_F(ServiceOnAFakeWire, ShowsItsPairOfEndpointsAndTheHashOfEach) {
  EXPECT_EQ(in().topic.type, "std_srvs::srv::dds_::SetBool_Request_");
  EXPECT_EQ(out().topic.type, "std_srvs::srv::dds_::SetBool_Response_");
  // The hashes that ROS 2 has for this service.
  EXPECT_EQ(in().topic.user_data,
            "serviceid=7;typehash=RIHS01_c62fbb99d94e1b25e8ef9e109f9581956bb1b3361a45a4e5810c36a90d29932e;");
  EXPECT_EQ(out().topic.user_data,
            "serviceid=7;typehash=RIHS01_d0814e7f7b4880ab77e9c57426c7aa1562ab69f11eef8e2e968812f9cbd0b059;");
}

TEST_F(ServiceOnAFakeWire, AnswersInTheMannerOfRmwFastrtps) {
  find(fast_reader_);
  fast_request(true, 41);
  service_.poll(kNow);
  ASSERT_THAT(out().written, SizeIs(1));
  EXPECT_EQ(out().written[0].payload, ros2::encode(SetBool::Response{true, "on"}));
  EXPECT_EQ(out().written[0].related, (dds::SampleId{fast_reader_, 41}));
}

TEST_F(ServiceOnAFakeWire, AnswersInTheMannerOfRmwCyclonedds) {
  find(cyclone_reader_);
  cyclone_request(true, 0x1122334455667788, 9);
  service_.poll(kNow);
  ASSERT_THAT(out().written, SizeIs(1));
  EXPECT_EQ(out().written[0].payload, cyclone_response(0x1122334455667788, 9, {true, "on"}));
  EXPECT_EQ(out().written[0].related, std::nullopt);
}

TEST_F(ServiceOnAFakeWire, ReadsTheHeaderOfAClientWithAnotherByteOrder) {
  find(cyclone_reader_);
  in().waiting.push_back(
      {{0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 0, 0, 0, 0, 9, 1}, {cyclone_writer_, 1}, {}});
  service_.poll(kNow);
  ASSERT_THAT(out().written, SizeIs(1));
  EXPECT_EQ(out().written[0].payload, cyclone_response(0x0102030405060708, 9, {true, "on"}));
}

TEST_F(ServiceOnAFakeWire, AnswersBothKindsInTurnInTheOrderOfTheirRequests) {
  find(fast_reader_);
  find(cyclone_reader_);
  for (int i = 0; i < 10; ++i) {
    fast_request(i % 2 == 0, i);
    cyclone_request(i % 3 == 0, 5, i);
  }
  service_.poll(kNow);
  ASSERT_THAT(out().written, SizeIs(20));
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(out().written[2 * i].related, (dds::SampleId{fast_reader_, i}));
    EXPECT_EQ(out().written[2 * i + 1].payload,
              cyclone_response(5, i, {i % 3 == 0, i % 3 == 0 ? "on" : "off"}));
  }
}

TEST_F(ServiceOnAFakeWire, ActsAtOnceButHoldsTheReplyUntilTheClientsReaderIsFound) {
  fast_request(true, 1);
  cyclone_request(true, 5, 1);
  service_.poll(kNow);
  EXPECT_EQ(requests_, 2);
  EXPECT_THAT(out().written, IsEmpty());
  find(cyclone_reader_);
  service_.poll(kNow + milliseconds(1500));
  EXPECT_THAT(out().written, SizeIs(1));
  find(fast_reader_);
  service_.poll(kNow + milliseconds(1999));
  EXPECT_THAT(out().written, SizeIs(2));
  service_.poll(kNow + milliseconds(1999));
  EXPECT_THAT(out().written, SizeIs(2));
  EXPECT_EQ(requests_, 2);
}

TEST_F(ServiceOnAFakeWire, AReplyAlsoWaitsForAReaderThatIsThereButHasNotFoundTheWriter) {
  find(cyclone_reader_);
  out().found = false;
  cyclone_request(true, 5, 1);
  service_.poll(kNow);
  EXPECT_THAT(out().written, IsEmpty());
  out().found = true;
  service_.poll(kNow);
  EXPECT_THAT(out().written, SizeIs(1));
}

TEST_F(ServiceOnAFakeWire, CallsWaitUntilTheyMayBeAnswered) {
  bool may_answer = false;
  ServiceDescription description = kDescription;
  description.name = "/later";
  description.may_answer = [&] { return may_answer; };
  Service later(participant_, description, "8", [this](ByteView bytes) { return respond(bytes); });
  wire_.writer_of("rr/laterReply").readers.push_back(cyclone_reader_);
  ros2::CdrWriter out;
  out.number(std::uint64_t{5});
  out.number(std::int64_t{1});
  out.number(std::uint8_t{1});
  wire_.reader_of("rq/laterRequest").waiting.push_back({out.bytes(), {cyclone_writer_, 1}, std::nullopt});
  later.poll(kNow);
  EXPECT_EQ(requests_, 0);
  // Meanwhile a flood is left to DDS, which has its bounds.
  auto& flood = wire_.reader_of("rq/laterRequest").waiting;
  for (int i = 0; i < 2; ++i) {
    flood.assign(Service::kDepth, {{}, {cyclone_writer_, 2}, std::nullopt});
    later.poll(kNow);
  }
  EXPECT_THAT(flood, SizeIs(Service::kDepth));
  may_answer = true;
  later.poll(kNow);
  EXPECT_EQ(requests_, 1);
  EXPECT_THAT(wire_.writer_of("rr/laterReply").written, SizeIs(1));
}

TEST_F(ServiceOnAFakeWire, AClientThatIsNotFoundForTwoSecondsGetsNoReply) {
  fast_request(true, 1);
  service_.poll(kNow);
  service_.poll(kNow + milliseconds(2000));
  find(fast_reader_);
  service_.poll(kNow + milliseconds(2001));
  EXPECT_THAT(out().written, IsEmpty());
}

TEST_F(ServiceOnAFakeWire, AnOldClientThatDoesNotNameItsReaderIsAnsweredAtOnce) {
  in().waiting.push_back({ros2::encode(SetBool::Request{true}), {fast_writer_, 3}, std::nullopt});
  service_.poll(kNow);
  ASSERT_THAT(out().written, SizeIs(1));
  EXPECT_EQ(out().written[0].related, (dds::SampleId{fast_writer_, 3}));
}

TEST_F(ServiceOnAFakeWire, HoldsNoMoreThanAHundredRepliesForClientsThatNeverCome) {
  for (int i = 0; i < 1000; ++i) {
    fast_request(true, i);
    service_.poll(kNow);
  }
  find(fast_reader_);
  service_.poll(kNow);
  ASSERT_THAT(out().written, SizeIs(Service::kMostHeld));
  EXPECT_EQ(out().written.back().related, (dds::SampleId{fast_reader_, 999})) << "the newest stay";
}

TEST_F(ServiceOnAFakeWire, BytesThatAreNoRequestAreNotAnswered) {
  find(fast_reader_);
  find(cyclone_reader_);
  for (const Bytes& bytes :
       {Bytes{}, Bytes{0}, Bytes{0, 1, 0, 0}, Bytes{0, 7, 0, 0, 1}, Bytes{1, 1, 0, 0, 1}})
    for (const dds::Guid& writer : {fast_writer_, cyclone_writer_})
      in().waiting.push_back({bytes, {writer, 1}, dds::SampleId{fast_reader_, -1}});
  for (std::size_t size = 4; size < 20; ++size) {
    Bytes bytes(size, 0);
    bytes[1] = 1;
    in().waiting.push_back({bytes, {cyclone_writer_, 1}, std::nullopt});
  }
  service_.poll(kNow);
  EXPECT_EQ(requests_, 0);
  EXPECT_THAT(out().written, IsEmpty());
}

TEST(RequestStyles, AValueIsFoundByItsWholeKey) {
  EXPECT_EQ(value_in("clientid=1.2;typehash=x;", "clientid"), "1.2");
  EXPECT_EQ(value_in("typehash=x;clientid=1.2", "clientid"), "1.2");
  EXPECT_EQ(value_in("myclientid=1;", "clientid"), "");
  EXPECT_EQ(value_in("clientid2=1;", "clientid"), "");
  EXPECT_EQ(value_in("clientid", "clientid"), "");
  EXPECT_EQ(value_in(";;=;", "clientid"), "");
}

}  // namespace
}  // namespace astro::live
