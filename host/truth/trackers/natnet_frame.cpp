#include "host/truth/trackers/natnet_frame.hpp"

#include <cmath>

namespace astro::truth::natnet {
namespace {

constexpr Version kSized{4, 1};  // from here on each section tells its size, and frames have a precise time
constexpr std::size_t kPoint = 12, kBodyBytes = 38, kMarkerBytes = 26;
constexpr std::size_t kSuffix = 46, kSuffixWithPreciseTime = 54;

/// Reads the sections of a frame. An impossible count makes the cursor !ok().
class Walk {
 public:
  Walk(ByteView payload, Version version) : cursor_(payload), sized_(version >= kSized) {}

  ByteCursor& cursor() { return cursor_; }

  /// Calls `one` for each element. In versions that state the section's size, it skips the section instead.
  template <class One>
  void section(One one) {
    const auto count = cursor_.number<std::int32_t>();
    if (sized_) {
      skip_sized();
      return;
    }
    each(count, one);
  }
  template <class One>
  void each(std::int32_t count, One one) {
    if (count < 0) cursor_.take(cursor_.left() + 1);
    for (std::int32_t i = 0; i < count && cursor_.ok(); ++i) one();
  }
  void skip(std::uint64_t bytes) { cursor_.take(bytes); }
  std::int32_t count() { return cursor_.number<std::int32_t>(); }
  void skip_sized() {
    const auto bytes = cursor_.number<std::int32_t>();
    cursor_.take(bytes < 0 ? cursor_.left() + 1 : static_cast<std::uint64_t>(bytes));
  }
  bool sized() const { return sized_; }

 private:
  ByteCursor cursor_;
  bool sized_;
};

RigidBody take_body(ByteCursor& cursor) {
  RigidBody body;
  body.id = cursor.number<std::int32_t>();
  const auto next = [&] { return static_cast<double>(cursor.number<float>()); };
  Pose3& p = body.pose;
  for (double* number : {&p.x_m, &p.y_m, &p.z_m, &p.qx, &p.qy, &p.qz, &p.qw}) *number = next();
  next();  // the markers' mean error
  body.tracked = (cursor.number<std::int16_t>() & 1) != 0;
  return body;
}

void take_bodies(Walk& walk, std::vector<RigidBody>& bodies) {
  const std::int32_t count = walk.count();
  if (walk.sized()) walk.skip(sizeof(std::int32_t));
  walk.each(count, [&] {
    const RigidBody body = take_body(walk.cursor());
    if (walk.cursor().ok()) bodies.push_back(body);
  });
}

/// Force plates and other devices: channels with numbers.
void skip_devices(Walk& walk) {
  walk.section([&] {
    walk.skip(4);
    walk.each(walk.count(), [&] { walk.each(walk.count(), [&] { walk.skip(4); }); });
  });
}

void skip_to_suffix(Walk& walk) {
  walk.section([&] {  // skeletons
    walk.skip(4);
    walk.each(walk.count(), [&] { walk.skip(kBodyBytes); });
  });
  if (walk.sized()) walk.section([] {});           // assets
  walk.section([&] { walk.skip(kMarkerBytes); });  // labelled markers
  skip_devices(walk);
  skip_devices(walk);
}

/// The times, which stand at the end of every version. Of 4.0 it is not known whether the precise time is
/// among them.
bool take_suffix(ByteCursor& cursor, Version version, Frame& frame) {
  const bool precise = version.major >= 4 && cursor.left() == kSuffixWithPreciseTime;
  if (!precise && (version >= kSized || cursor.left() != kSuffix)) return false;
  cursor.take(8);  // the time code
  frame.timestamp_s = cursor.number<double>();
  frame.exposed_ticks = cursor.number<std::uint64_t>();
  frame.received_ticks = cursor.number<std::uint64_t>();
  frame.sent_ticks = cursor.number<std::uint64_t>();
  if (precise) cursor.take(8);
  frame.models_changed = (cursor.number<std::int16_t>() & 2) != 0;
  return cursor.number<std::int32_t>() == 0;
}

}  // namespace

std::optional<Frame> frame_in(ByteView payload, Version version) {
  Walk walk(payload, version);
  Frame frame;
  frame.number = walk.cursor().number<std::int32_t>();
  walk.section([&] {  // marker sets
    take_text(walk.cursor());
    walk.each(walk.count(), [&] { walk.skip(kPoint); });
  });
  walk.section([&] { walk.skip(kPoint); });  // markers without a name
  take_bodies(walk, frame.bodies);
  if (!walk.cursor().ok()) return std::nullopt;
  skip_to_suffix(walk);
  ByteCursor& end = walk.cursor();
  const bool has_more = end.ok() && end.left() > kSuffixWithPreciseTime;
  if (version > kSized && has_more) end.take(end.left() - kSuffixWithPreciseTime);
  return end.ok() && take_suffix(end, version, frame) ? std::optional(frame) : std::nullopt;
}

Bytes payload_of(const Frame& frame, Version version) {
  const bool sized = version >= kSized;
  Bytes bytes;
  const auto empty = [&] {
    append(bytes, std::int32_t{0});
    if (sized) append(bytes, std::int32_t{0});
  };
  append(bytes, frame.number);
  empty();
  empty();
  append(bytes, static_cast<std::int32_t>(frame.bodies.size()));
  if (sized) append(bytes, static_cast<std::int32_t>(frame.bodies.size() * kBodyBytes));
  for (const RigidBody& body : frame.bodies) {
    const Pose3& p = body.pose;
    append(bytes, body.id);
    for (const double number : {p.x_m, p.y_m, p.z_m, p.qx, p.qy, p.qz, p.qw, 0.0})
      append(bytes, static_cast<float>(number));
    append(bytes, static_cast<std::int16_t>(body.tracked ? 1 : 0));
  }
  for (int section = 0; section < (sized ? 5 : 4); ++section) empty();
  append(bytes, std::uint64_t{0});  // the time code
  append(bytes, frame.timestamp_s);
  append(bytes, frame.exposed_ticks);
  append(bytes, frame.received_ticks);
  append(bytes, frame.sent_ticks);
  if (sized) append(bytes, std::uint64_t{0});
  append(bytes, static_cast<std::int16_t>(frame.models_changed ? 2 : 0));
  append(bytes, std::int32_t{0});
  return bytes;
}

std::int64_t exposed_us(const Frame& frame, std::uint64_t ticks_per_s) {
  constexpr double kMostSeconds = 1e12;
  const std::uint64_t ticks = frame.exposed_ticks != 0 ? frame.exposed_ticks : frame.sent_ticks;
  double seconds = frame.timestamp_s, rest_us = 0;
  if (ticks != 0 && ticks_per_s != 0) {
    // Whole seconds and the rest are converted separately, because a double of all ticks loses the
    // microseconds after some years.
    seconds = static_cast<double>(ticks / ticks_per_s);
    rest_us = 1e6 * static_cast<double>(ticks % ticks_per_s) / static_cast<double>(ticks_per_s);
  }
  if (!(std::abs(seconds) < kMostSeconds)) return 0;
  const double whole = std::floor(seconds);
  return static_cast<std::int64_t>(whole) * 1'000'000 + std::llround(1e6 * (seconds - whole) + rest_us);
}

}  // namespace astro::truth::natnet
