#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "host/base/error.hpp"
#include "host/truth/trackers/vrpn_directory.hpp"
#include "host/truth/trackers/vrpn_reader.hpp"
#include "host/truth/trackers/vrpn_tracker.hpp"
#include "tests/support/base/places.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::truth::vrpn {
namespace {

using support::Tells;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int32_t kAstro = 2, kPose = 8;

/// What a server sends at first, and three poses.
Bytes some_stream() {
  Bytes bytes = cookie();
  append_description(bytes, kSenderDescription, 0, "VRPN Control", 1);
  append_description(bytes, kSenderDescription, kAstro, "ASTRO", 1);
  append_description(bytes, kTypeDescription, kPose, kPoseType, 1);
  for (int i = 0; i < 3; ++i)
    append(bytes, {1'700'000'000'250'000 + 10'000 * i, kAstro, kPose, static_cast<std::uint32_t>(i),
                   payload_of({0, {1.5 + i, -2.25, 0.125, 0, 0, 0.6, 0.8}})});
  return bytes;
}

/// A message with a payload of its own, to compare.
struct Kept {
  std::int64_t time_us;
  std::int32_t sender, type;
  Bytes payload;
  bool operator==(const Kept&) const = default;
};

struct Outcome {
  std::vector<Kept> messages;
  std::string complaint;
  Kind kind;
  std::vector<std::string> values;
  bool operator==(const Outcome&) const = default;
  Remark told() const { return {complaint, kind, values}; }
};

/// Everything that a stream gives if it arrives in pieces of at most `piece` bytes.
Outcome read(ByteView bytes, std::size_t piece) {
  Outcome outcome;
  StreamReader reader;
  try {
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      reader.push(bytes.subspan(at, std::min(piece, bytes.size() - at)));
      while (const auto message = reader.next())
        outcome.messages.push_back({message->time_us,
                                    message->sender,
                                    message->type,
                                    {message->payload.begin(), message->payload.end()}});
    }
  } catch (const Error& error) {
    outcome.complaint = error.what();
    outcome.kind = error.kind();
    outcome.values = error.values();
  }
  return outcome;
}

Remark told_about_datagram(ByteView bytes) {
  return support::told_by([&] { messages_in(bytes); });
}

// ---- bytes

TEST(VrpnMessage, APoseHasTheBytesOfTheUpstreamLibrary) {
  Bytes bytes;
  append(bytes, {1'795'218'077'755'151, 2, 8, 3, payload_of({1, {1.0, -2.0, 0.5, 0, 0, 0, 1}})});
  const Bytes expected{0,    0,    0,    88,                            // length, header included
                       0x6B, 0x00, 0xDA, 0x9D, 0x00, 0x0B, 0x85, 0xCF,  // seconds, microseconds
                       0,    0,    0,    2,    0,    0,    0,    8,     // sender, type
                       0,    0,    0,    3,                             // sequence
                       0,    0,    0,    1,    0,    0,    0,    0,     // sensor, filler
                       0x3F, 0xF0, 0,    0,    0,    0,    0,    0,     // x
                       0xC0, 0,    0,    0,    0,    0,    0,    0,     // y
                       0x3F, 0xE0, 0,    0,    0,    0,    0,    0,     // z
                       0,    0,    0,    0,    0,    0,    0,    0,     // qx
                       0,    0,    0,    0,    0,    0,    0,    0,     // qy
                       0,    0,    0,    0,    0,    0,    0,    0,     // qz
                       0x3F, 0xF0, 0,    0,    0,    0,    0,    0};    // qw
  EXPECT_EQ(bytes, expected);
}

TEST(VrpnMessage, ADescriptionIsPaddedAndItsLengthDoesNotCountThat) {
  Bytes bytes;
  append_description(bytes, kSenderDescription, 0, "VRPN Control", 0);
  ASSERT_EQ(bytes.size(), 48U);
  EXPECT_EQ(length_in(bytes), 0x29U) << "24 + 4 + 12 + 1";
  const Message message = message_in(bytes);
  EXPECT_EQ(message.type, kSenderDescription);
  EXPECT_EQ(name_in(message.payload), "VRPN Control");
}

TEST(VrpnMessage, ANameEndsAtItsFirstNulAndWithinItsPayload) {
  EXPECT_EQ(name_in(Bytes{0, 0, 0, 4, 'a', 0, 'b', 0}), "a");
  EXPECT_EQ(name_in(Bytes{0, 0, 0, 1, 'a'}), "a") << "without a NUL";
  EXPECT_EQ(name_in(Bytes{0, 0, 0, 0}), "");
  EXPECT_EQ(name_in(Bytes{0, 0, 0, 3, 'a', 0}), std::nullopt);
  EXPECT_EQ(name_in(Bytes{0xFF, 0xFF, 0xFF, 0xFF, 'a', 0}), std::nullopt);
  EXPECT_EQ(name_in(Bytes{0, 0, 0}), std::nullopt);
}

TEST(VrpnMessage, APoseOfAnotherSizeIsNone) {
  const Bytes pose = payload_of({});
  EXPECT_TRUE(pose_in(pose));
  EXPECT_FALSE(pose_in(ByteView(pose).first(63)));
  EXPECT_FALSE(pose_in(Bytes(72)));
  EXPECT_FALSE(pose_in({}));
}

TEST(VrpnCookie, OfAnyMinorVersionIsTakenAndOfAnotherVersionNot) {
  Bytes other = cookie();
  EXPECT_EQ(other.size(), kCookieBytes);
  other[14] = '9';
  EXPECT_TRUE(is_cookie(other));
  other[11] = '8';
  EXPECT_FALSE(is_cookie(other));
}

// ---- streams

TEST(VrpnStreamReader, GivesTheSameMessagesInPiecesOfAnySize) {
  const Bytes bytes = some_stream();
  const Outcome whole = read(bytes, bytes.size());
  EXPECT_EQ(whole.complaint, "");
  ASSERT_EQ(whole.messages.size(), 6U);
  EXPECT_EQ(whole.messages[4].time_us, 1'700'000'000'260'000);
  EXPECT_EQ(pose_in(whole.messages[5].payload)->pose, (Pose3{3.5, -2.25, 0.125, 0, 0, 0.6, 0.8}));
  for (std::size_t piece = 1; piece < 100; ++piece) EXPECT_EQ(read(bytes, piece), whole) << piece;
}

TEST(VrpnStreamReader, CutAtEveryByteItGivesAPrefix) {
  const Bytes bytes = some_stream();
  const Outcome whole = read(bytes, bytes.size());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Outcome cut = read(ByteView(bytes).first(size), 16);
    EXPECT_EQ(cut.complaint, "") << size;
    EXPECT_LT(cut.messages.size(), whole.messages.size()) << size;
    EXPECT_TRUE(std::equal(cut.messages.begin(), cut.messages.end(), whole.messages.begin())) << size;
  }
}

TEST(VrpnStreamReader, RefusesAnotherProgramByItsFirstBytes) {
  for (const char* bytes : {"SSH-2.0-OpenSSH", "vrpn: ver. 06.11  0"})
    EXPECT_THAT(read(as_bytes(bytes), 1).told(), Tells(VrpnProblem::other_program)) << bytes;
}

TEST(VrpnStreamReader, RefusesALengthThatNoMessageHasAndNamesTheByte) {
  for (const std::uint32_t length : {0U, 23U, 64'001U, 0xFFFF'FFFFU}) {
    Bytes bytes = cookie();
    append_description(bytes, kSenderDescription, 1, "ASTRO", 0);
    const std::size_t at = bytes.size();
    append(bytes, {0, 1, 1, 0, {}});
    for (int i = 0; i < 4; ++i)
      bytes[at + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(length >> (24 - 8 * i));
    const Outcome outcome = read(bytes, 7);
    EXPECT_EQ(outcome.messages.size(), 1U);
    EXPECT_THAT(outcome.told(),
                Tells(VrpnProblem::impossible_length, std::to_string(length), std::to_string(at)));
  }
}

TEST(VrpnStreamReader, GarbledItRefusesOrGoesOnButTheSameInPiecesOfAnySize) {
  constexpr unsigned kSeed = 3883;
  std::mt19937 random(kSeed);
  const Bytes bytes = some_stream();
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    Bytes garbled = bytes;
    for (int changes = 1 + static_cast<int>(random() % 4); changes > 0; --changes) {
      const auto at = static_cast<std::ptrdiff_t>(random() % garbled.size());
      switch (random() % 3) {
        case 0:
          garbled[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(random());
          break;
        case 1:
          garbled.erase(garbled.begin() + at);
          break;
        default:
          garbled.insert(garbled.begin() + at, static_cast<std::uint8_t>(random()));
      }
    }
    const Outcome whole = read(garbled, garbled.size());
    EXPECT_EQ(read(garbled, 1 + random() % 40), whole) << "seed " << kSeed << ", number " << i;
    refused += whole.complaint.empty() ? 0 : 1;
    Directory directory;
    for (const Kept& kept : whole.messages) {
      const Message message{kept.time_us, kept.sender, kept.type, 0, kept.payload};
      if (!directory.take(message)) pose_in(message.payload);
    }
  }
  EXPECT_GT(refused, 200) << "of 2000, seed " << kSeed;
  EXPECT_LT(refused, 1800) << "of 2000, seed " << kSeed;
}

// ---- datagrams

TEST(VrpnDatagram, HoldsSeveralMessages) {
  const Bytes stream = some_stream();
  const auto messages = messages_in(ByteView(stream).subspan(kCookieBytes));
  ASSERT_EQ(messages.size(), 6U);
  EXPECT_EQ(messages[3].type, kPose);
}

TEST(VrpnDatagram, ThatIsCutIsRefusedExceptBetweenMessagesAndInPadding) {
  const Bytes stream = some_stream();
  const ByteView whole = ByteView(stream).subspan(kCookieBytes);
  int taken = 0;
  for (std::size_t size = 0; size < whole.size(); ++size)
    taken += told_about_datagram(whole.first(size)).sentence.empty() ? 1 : 0;
  // No byte; after each of the 5 first messages; and within the padding of the 3 descriptions: 7, 6 and 6 bytes.
  EXPECT_EQ(taken, 1 + 5 + 7 + 6 + 6);
  EXPECT_THAT(told_about_datagram(whole.first(20)), Tells(VrpnProblem::no_header, "20"));
  EXPECT_THAT(told_about_datagram(whole.first(30)), Tells(VrpnProblem::cut_off, "41", "30"));
}

// ---- names

Message described(const Bytes& bytes) { return message_in(bytes); }

TEST(VrpnDirectory, NamesAreThoseOfTheServerWhateverIdsItGives) {
  Directory directory;
  const auto describe = [&](std::int32_t kind, std::int32_t id, std::string_view name) {
    Bytes bytes;
    append_description(bytes, kind, id, name, 0);
    EXPECT_TRUE(directory.take(described(bytes)));
  };
  EXPECT_EQ(directory.sender(7), "");
  describe(kSenderDescription, 0, "VRPN Control");
  describe(kSenderDescription, 7, "robot on the floor");
  describe(kSenderDescription, -3, "ASTRO");
  describe(kSenderDescription, 5, "vrpn_Forwarder_Brain");
  describe(kTypeDescription, 7, kPoseType);
  EXPECT_EQ(directory.sender(7), "robot on the floor");
  EXPECT_EQ(directory.type(7), kPoseType);
  EXPECT_THAT(directory.bodies(), ElementsAre("ASTRO", "robot on the floor"));
  describe(kSenderDescription, 7, "renamed");
  EXPECT_THAT(directory.bodies(), ElementsAre("ASTRO", "renamed"));
}

TEST(VrpnDirectory, OfAnEndlessListTheFirst2000AreKept) {
  Directory directory;
  for (std::int32_t id = 0; id < 5000; ++id) {
    Bytes bytes;
    append_description(bytes, kSenderDescription, id, "body" + std::to_string(id), 0);
    directory.take(described(bytes));
  }
  EXPECT_EQ(directory.bodies().size(), 2000U);
}

TEST(VrpnDirectory, ADescriptionThatCannotBeReadNamesNothing) {
  Directory directory;
  const Bytes cut{0, 0, 0, 9, 'a'};
  EXPECT_TRUE(directory.take({0, 1, kSenderDescription, 0, cut}));
  EXPECT_THAT(directory.bodies(), IsEmpty());
  EXPECT_FALSE(directory.take({0, 1, kUdpDescription, 0, {}}));
}

// ---- a recording of the upstream server, which is beside a developer's checkout

TEST(VrpnUpstream, ThreeSecondsOfItsServerAreReadWhole) {
  const std::filesystem::path path = support::shared_data() / "samples/vrpn/vrpn_07.38_server_tcp_3s.bin";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "not at hand: " << path;
  std::ifstream file(path, std::ios::binary);
  const Bytes bytes(std::istreambuf_iterator<char>(file), {});
  const Outcome outcome = read(bytes, 1000);
  EXPECT_EQ(outcome.complaint, "");
  EXPECT_EQ(outcome.messages.size(), 1591U);
  Directory directory;
  std::vector<double> times_s, headings_rad;
  for (const Kept& kept : outcome.messages) {
    if (directory.take({kept.time_us, kept.sender, kept.type, 0, kept.payload})) continue;
    if (directory.type(kept.type) != kPoseType || directory.sender(kept.sender) != "astro") continue;
    const auto pose = pose_in(kept.payload);
    ASSERT_TRUE(pose);
    times_s.push_back(static_cast<double>(kept.time_us) * 1e-6);
    headings_rad.push_back(on_floor(pose->pose, UpAxis::z).theta_rad);
  }
  EXPECT_THAT(directory.bodies(), ElementsAre("Tracker0", "astro"));
  // Its configuration: 0.1 turns per second about z, at most 60 poses per second; its main loop sleeps a little
  // longer than it should.
  ASSERT_GT(times_s.size(), 150U);
  const double span_s = times_s.back() - times_s.front();
  EXPECT_NEAR(static_cast<double>(times_s.size() - 1) / span_s, 58, 2);
  EXPECT_NEAR((headings_rad.back() - headings_rad.front()) / span_s, 0.1 * 2 * 3.14159265358979, 0.02);
}

}  // namespace
}  // namespace astro::truth::vrpn
