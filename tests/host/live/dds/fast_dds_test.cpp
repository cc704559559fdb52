#include "host/live/dds/fast_dds.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "host/base/error.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/ros2/domain.hpp"

namespace astro::dds {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using testing::ElementsAre;

constexpr auto kLong = std::chrono::seconds(60);  // only a failure waits so long

std::unique_ptr<Participant> open(const std::string& name = "test", const std::string& user_data = "") {
  return open_fast_dds({support::test_domain()}, name, user_data);
}

Topic topic_of(const std::string& type = "test_msgs::msg::dds_::A_") { return {"rt/a", type}; }

/// Both DDS threads and the other participant's work on; here is nothing to do but wait.
bool eventually(Participant& participant, const std::function<bool()>& done) {
  const auto begin = steady_clock::now();
  while (!done()) {
    if (steady_clock::now() - begin > kLong) return false;
    participant.wait(milliseconds(5));
  }
  return true;
}

Bytes payload(std::uint8_t what) { return {0, 1, 0, 0, what, 0, 0, 0}; }

std::vector<Bytes> payloads(const std::vector<Sample>& samples) {
  std::vector<Bytes> all;
  for (const Sample& sample : samples) all.push_back(sample.payload);
  return all;
}

TEST(FastDds, BytesComeToAnotherParticipantAsTheyWereWritten) {
  const auto here = open(), there = open();
  const auto writer = here->create_writer(topic_of());
  const auto reader = there->create_reader(topic_of());
  ASSERT_TRUE(eventually(*there, [&] { return !writer->readers().empty() && !reader->writers().empty(); }));
  EXPECT_THAT(writer->readers(), ElementsAre(reader->guid()));
  EXPECT_THAT(reader->writers(), ElementsAre(writer->guid()));
  Bytes large = payload(1);
  large.resize(200'000, 7);
  writer->write(payload(1));
  writer->write(large);
  std::vector<Sample> samples;
  ASSERT_TRUE(eventually(*there, [&] {
    for (Sample& sample : reader->take()) samples.push_back(std::move(sample));
    return samples.size() == 2;
  }));
  EXPECT_THAT(payloads(samples), ElementsAre(payload(1), large));
  EXPECT_EQ(samples[0].id, (SampleId{writer->guid(), 1}));
  EXPECT_EQ(samples[1].id, (SampleId{writer->guid(), 2}));
  EXPECT_FALSE(samples[0].related);
}

TEST(FastDds, ParticipantsFindEachOtherHoweverManyHaveGone) {
  // Without multicast the others are looked for at the first 32 numbers.
  for (int gone = 0; gone < 40; ++gone) open();
  const auto here = open(), there = open();
  EXPECT_NE(here->guid(), there->guid());
  const auto writer = here->create_writer(topic_of());
  const auto reader = there->create_reader(topic_of());
  EXPECT_TRUE(eventually(*there, [&] { return !writer->readers().empty() && !reader->writers().empty(); }));
}

TEST(FastDds, WhoComesLateGetsTheLastSampleOfALatchedTopicAndNothingOfAnother) {
  const auto here = open();
  Topic latched = topic_of();
  latched.qos = {true, true, 1};
  Topic passing = topic_of();
  passing.name = "rt/b";
  const auto first = here->create_writer(latched), second = here->create_writer(passing);
  first->write(payload(1));
  first->write(payload(2));
  second->write(payload(3));
  const auto there = open();
  const auto reader = there->create_reader(latched), other = there->create_reader(passing);
  std::vector<Sample> samples;
  ASSERT_TRUE(eventually(*there, [&] {
    for (Sample& sample : reader->take()) samples.push_back(std::move(sample));
    return !samples.empty() && !other->writers().empty() && !second->readers().empty();
  }));
  EXPECT_THAT(payloads(samples), ElementsAre(payload(2)));
  second->write(payload(4));
  std::vector<Sample> passed;
  ASSERT_TRUE(eventually(*there, [&] { return !(passed = other->take()).empty(); }));
  EXPECT_THAT(payloads(passed), ElementsAre(payload(4)));
}

TEST(FastDds, AReplyCarriesWhatItAnswers) {
  const auto here = open(), there = open();
  const auto writer = here->create_writer(topic_of());
  const auto reader = there->create_reader(topic_of());
  ASSERT_TRUE(eventually(*there, [&] { return !writer->readers().empty() && !reader->writers().empty(); }));
  const SampleId request{reader->guid(), (std::int64_t{3} << 32) + 5};
  writer->write(payload(1), request);
  std::vector<Sample> samples;
  ASSERT_TRUE(eventually(*there, [&] { return !(samples = reader->take()).empty(); }));
  EXPECT_EQ(samples[0].related, request);
}

TEST(FastDds, OneTopicUnderTwoTypesComesToTheReaderOfEach) {
  const auto here = open(), there = open();
  const Topic a = topic_of(), b = topic_of("test_msgs::msg::dds_::B_");
  const auto reads_a = here->create_reader(a), reads_b = here->create_reader(b);
  const auto writes_a = there->create_writer(a), writes_b = there->create_writer(b);
  ASSERT_TRUE(eventually(*here, [&] {
    return reads_a->writers().size() == 1 && reads_b->writers().size() == 1 &&
           writes_a->readers().size() == 1 && writes_b->readers().size() == 1;
  }));
  writes_a->write(payload(1));
  writes_b->write(payload(2));
  std::vector<Sample> from_a, from_b;
  ASSERT_TRUE(eventually(*here, [&] { return !(from_a = reads_a->take()).empty(); }));
  ASSERT_TRUE(eventually(*here, [&] { return !(from_b = reads_b->take()).empty(); }));
  EXPECT_THAT(payloads(from_a), ElementsAre(payload(1)));
  EXPECT_THAT(payloads(from_b), ElementsAre(payload(2)));
}

TEST(FastDds, WhatEndpointsShowOfThemselvesIsSeenUntilTheyGo) {
  const auto here = open();
  auto there = open();
  Topic shown = topic_of();
  shown.user_data = "clientid=1.2;";
  auto writer = there->create_writer(shown);
  const auto reader = here->create_reader(topic_of());
  ASSERT_TRUE(eventually(*here, [&] { return reader->writers().size() == 1; }));
  EXPECT_EQ(here->user_data_of(writer->guid()), "clientid=1.2;");
  const Guid gone = writer->guid();
  writer.reset();
  EXPECT_TRUE(
      eventually(*here, [&] { return reader->writers().empty() && here->user_data_of(gone).empty(); }));
}

TEST(FastDds, TheEndpointsOfOthersAreKnownByTopicAndTypeAndItsOwnAreNot) {
  const auto here = open(), there = open();
  const auto own = here->create_writer(topic_of()),
             beside = here->create_writer(topic_of("test_msgs::msg::dds_::B_"));
  auto writer = there->create_writer(topic_of());
  const auto reader = there->create_reader({"rt/c", "test_msgs::msg::dds_::C_"});
  std::vector<RemoteEndpoint> known;
  ASSERT_TRUE(eventually(*here, [&] { return (known = here->remote_endpoints()).size() == 2; }));
  if (!known[0].writes) std::swap(known[0], known[1]);
  EXPECT_EQ(known[0].guid, writer->guid());
  EXPECT_TRUE(known[0].writes);
  EXPECT_EQ(known[0].topic, "rt/a");
  EXPECT_EQ(known[0].type, "test_msgs::msg::dds_::A_");
  EXPECT_EQ(known[1].guid, reader->guid());
  EXPECT_FALSE(known[1].writes);
  EXPECT_EQ(known[1].topic, "rt/c");
  writer.reset();
  EXPECT_TRUE(eventually(*here, [&] { return here->remote_endpoints().size() == 1; }));
}

TEST(FastDds, ParticipantsOfAnotherDomainOrOfNoRangeAreNotMet) {
  const auto here = open();
  const auto elsewhere = open_fast_dds({support::test_domain() + 1}, "test", "");
  const auto hidden = open_fast_dds({support::test_domain(), Range::off}, "test", "");
  const auto there = open();
  const auto writer = here->create_writer(topic_of());
  const auto far = elsewhere->create_reader(topic_of()), unseen = hidden->create_reader(topic_of());
  const auto reader = there->create_reader(topic_of());
  ASSERT_TRUE(eventually(*there, [&] { return !writer->readers().empty(); }));
  EXPECT_THAT(writer->readers(), ElementsAre(reader->guid())) << "the others were there before it";
}

TEST(FastDds, ASampleThatIsTooLargeIsSkippedAndThoseAfterItAreNot) {
  const auto here = open(), there = open();
  const auto writer = here->create_writer(topic_of());
  const auto reader = there->create_reader(topic_of());
  ASSERT_TRUE(eventually(*there, [&] { return !writer->readers().empty() && !reader->writers().empty(); }));
  Bytes too_large = payload(1);
  writer->write(payload(2));
  for (const std::size_t size : {std::size_t{3'000'000}, (std::size_t{1} << 20) + 1}) {
    too_large.resize(size);
    writer->write(too_large);
  }
  writer->write(payload(3));
  std::vector<Sample> samples;
  ASSERT_TRUE(eventually(*there, [&] {
    for (Sample& sample : reader->take()) samples.push_back(std::move(sample));
    return samples.size() == 2;
  }));
  EXPECT_THAT(payloads(samples), ElementsAre(payload(2), payload(3)));
}

TEST(FastDds, AsManySamplesAreKeptAsTheDepthSays) {
  Topic deep = topic_of();
  deep.qos = {true, true, 1000};  // more than Fast DDS keeps of its own accord
  const auto here = open();
  const auto writer = here->create_writer(deep);
  for (int i = 0; i < 1500; ++i) writer->write(payload(static_cast<std::uint8_t>(i % 251)));
  const auto there = open();
  const auto reader = there->create_reader(deep);
  std::vector<Sample> samples;
  ASSERT_TRUE(eventually(*there, [&] {
    for (Sample& sample : reader->take()) samples.push_back(std::move(sample));
    return samples.size() >= 1000;
  }));
  EXPECT_EQ(samples.size(), 1000U);
  EXPECT_EQ(samples.front().id.number, 501);
}

TEST(FastDds, AReaderThatIsNotAskedKeepsNoMoreThanItsDepth) {
  const auto here = open(), there = open();
  const auto writer = here->create_writer(topic_of());
  const auto reader = there->create_reader(topic_of());
  ASSERT_TRUE(eventually(*there, [&] { return !writer->readers().empty() && !reader->writers().empty(); }));
  for (int i = 0; i < 1000; ++i) writer->write(payload(static_cast<std::uint8_t>(i % 251)));
  std::vector<Sample> samples;
  ASSERT_TRUE(eventually(*there, [&] {
    samples = reader->take();
    return !samples.empty() && samples.back().id.number == 1000;
  }));
  // Fewer if an earlier look came between two of the last ones.
  EXPECT_THAT(samples, testing::SizeIs(testing::Le(static_cast<std::size_t>(topic_of().qos.depth))));
}

TEST(FastDds, OneTakeEndsHoweverMuchComes) {
  Topic all = topic_of();
  all.qos = {true, true, 0};
  const auto here = open(), there = open();
  const auto writer = here->create_writer(all);
  const auto reader = there->create_reader(all);
  ASSERT_TRUE(eventually(*there, [&] { return !writer->readers().empty() && !reader->writers().empty(); }));
  for (std::size_t i = 0; i < 2 * Reader::kMostAtOnce; ++i) writer->write(payload(1));
  std::size_t taken = 0;
  ASSERT_TRUE(eventually(*there, [&] {
    const std::size_t now = reader->take().size();
    EXPECT_LE(now, Reader::kMostAtOnce);
    taken += now;
    return taken == 2 * Reader::kMostAtOnce;
  }));
}

// Under AddressSanitizer it would be seen if a listener were called after its reader has gone.
TEST(FastDds, ReadersMayGoWhileSamplesCome) {
  const auto here = open(), there = open();
  const auto writer = here->create_writer(topic_of());
  std::atomic<bool> done = false;
  std::thread flood([&] {
    while (!done) writer->write(payload(1));
  });
  std::size_t met = 0;
  for (int i = 0; i < 50; ++i) {
    const auto reader = there->create_reader(topic_of());
    eventually(*there, [&] { return !reader->take().empty(); }) ? ++met : met;
  }
  done = true;
  flood.join();
  EXPECT_EQ(met, 50U);
}

TEST(FastDds, OfAnEndpointThatShowsVeryMuchNothingIsKept) {
  const auto here = open(), there = open();
  Topic shown = topic_of();
  shown.user_data = "clientid=1;" + std::string(4000, 'x');
  const auto writer = there->create_writer(shown);
  const auto reader = here->create_reader(topic_of());
  ASSERT_TRUE(eventually(*here, [&] { return reader->writers().size() == 1; }));
  EXPECT_EQ(here->user_data_of(writer->guid()), "");
}

TEST(FastDds, APeerWithoutAnAddressIsNamed) {
  const Discovery with_unknown_peer{support::test_domain(), Range::localhost, {"no such host"}};
  EXPECT_THAT([&] { open_fast_dds(with_unknown_peer, "test", ""); },
              support::ThrowsTelling(DiscoveryProblem::peer_without_address, "no such host"));
}

}  // namespace
}  // namespace astro::dds
