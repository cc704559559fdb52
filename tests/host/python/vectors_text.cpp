#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/protocol/frame.hpp"
#include "tests/common/protocol/body_of.hpp"
#include "tests/host/python/messages_text.hpp"
#include "tests/host/python/schema.hpp"

namespace astro::python {
namespace {

using Json = nlohmann::ordered_json;
using protocol::detail::each;
using Bytes = std::vector<std::uint8_t>;

std::string hex(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) text += {kDigits[byte >> 4U], kDigits[byte & 15U]};
  return text;
}

/// What the fields of a message are set to. `pattern` gives every byte of a message another value.
enum class Filling { zero, least, greatest, pattern };
constexpr std::array kFillings{Filling::zero, Filling::least, Filling::greatest, Filling::pattern};

/// Counts up, so that an exchanged byte or field shows.
class Filler {
 public:
  explicit Filler(Filling filling) : filling_(filling) {}

  template <std::integral T>
  void fill(T& value) {
    using Limits = std::numeric_limits<T>;
    if (filling_ == Filling::pattern) {
      std::uint64_t bits = 0;
      for (std::size_t i = 0; i < sizeof(T); ++i) bits |= std::uint64_t{next()} << (8 * i);
      value = static_cast<T>(bits);
      return;
    }
    value = filling_ == Filling::least ? Limits::min() : filling_ == Filling::greatest ? Limits::max() : T{0};
  }
  template <Named E>
  void fill(E& value) {
    const std::size_t last = names(E{}).size() - 1;
    value = static_cast<E>(filling_ == Filling::greatest  ? last
                           : filling_ == Filling::pattern ? next() % (last + 1)
                                                          : 0);
  }
  template <std::size_t N>
  void fill(std::array<std::uint8_t, N>& bytes) {
    for (std::uint8_t& byte : bytes) fill(byte);
  }
  template <std::size_t N>
  void fill(Text<N>& text) {
    const std::size_t length = filling_ == Filling::greatest ? N : filling_ == Filling::pattern ? N / 2 : 0;
    std::string characters;
    while (characters.size() < length) characters += static_cast<char>('a' + next() % 26);
    text = Text<N>(characters);
  }
  template <protocol::detail::Record T>
  void fill(T& record) {
    each<false, T>([&](const auto& field) { fill(record.*field.member); });
  }

 private:
  std::uint8_t next() { return next_ = static_cast<std::uint8_t>(next_ * 5 + 13); }

  Filling filling_;
  std::uint8_t next_ = 1;
};

template <std::integral T>
Json json_of(T value) {
  return value;
}
template <Named E>
Json json_of(E value) {
  return static_cast<int>(value);
}
template <std::size_t N>
Json json_of(const std::array<std::uint8_t, N>& bytes) {
  return hex(bytes);
}
template <std::size_t N>
Json json_of(const Text<N>& text) {
  return text.view();
}
template <protocol::detail::Record T>
Json json_of(const T& record) {
  Json fields = Json::object();
  each<false, T>([&](const auto& field) { fields[std::string(field.name)] = json_of(record.*field.member); });
  each<true, T>([&](const auto& group) {
    if (protocol::detail::has(record, group.bit))
      fields[std::string(group.name)] = json_of(record.*group.member);
  });
  return fields;
}

template <Message M>
Json vector_of(const M& message, std::uint16_t request_id) {
  return {{"message", M::kName},
          {"request_id", request_id},
          {"fields", json_of(message)},
          {"body", hex(tests::body_of(message, request_id))},
          {"frame", hex(protocol::Frame(message, request_id).bytes())}};
}

/// The masks of groups that are tried: none, each alone, all.
template <Message M>
std::vector<std::uint32_t> masks() {
  std::vector<std::uint32_t> masks{0};
  each<true, M>([&](const auto& group) { masks.push_back(1U << group.bit); });
  if constexpr (protocol::detail::group_mask<M>() != 0) masks.push_back(protocol::detail::group_mask<M>());
  return masks;
}

template <Message M>
void add_vectors(Json& vectors) {
  for (const Filling filling : kFillings) {
    Filler filler(filling);
    M message;
    filler.fill(message);
    if constexpr (protocol::detail::group_mask<M>() != 0) {
      each<true, M>([&](const auto& group) { filler.fill(message.*group.member); });
      for (message.fields = 0; const std::uint32_t mask : masks<M>()) {
        message.fields = mask;
        vectors.push_back(vector_of(message, 0));
      }
    } else {
      std::uint16_t request_id = 0;
      filler.fill(request_id);
      vectors.push_back(vector_of(message, request_id));
    }
  }
}

template <Message M>
void add_refused(Json& refused, const Bytes& body, std::string_view what) {
  const auto decoded = protocol::decode<M>(body);
  refused.push_back({{"message", M::kName},
                     {"what", what},
                     {"body", hex(body)},
                     {"error", decoded.ok() ? "none" : std::string(name(decoded.error()))}});
}

template <Message M>
void add_refused_bodies(Json& refused) {
  const Bytes body = tests::body_of(M{}, 1);
  Bytes changed = body;
  changed.push_back(0);
  add_refused<M>(refused, changed, "a byte is left over");
  changed = Bytes(body.begin(), body.end() - 1);
  add_refused<M>(refused, changed, "the last byte is missing");
  changed = body;
  ++changed[0];
  add_refused<M>(refused, changed, "the id of another message");
}

template <Message M>
void add_bad_byte(Json& refused, std::size_t at, std::uint8_t value, std::string_view what) {
  Bytes body = tests::body_of(M{}, 1);
  body.at(at) = value;
  add_refused<M>(refused, body, what);
}

Json refused_bodies() {
  Json refused = Json::array();
  visit_messages([&]<Message M>() { add_refused_bodies<M>(refused); });
  add_bad_byte<protocol::AddSegment>(refused, 3, protocol::kSegmentKindNames.size(),
                                     "an unknown kind of segment");
  add_bad_byte<protocol::Booted>(refused, 3, 255, "an unknown cause");
  add_bad_byte<protocol::Telemetry>(refused, 12, 0x04, "a bit of no group");
  add_bad_byte<protocol::HelloReply>(refused, 25, 'x', "text behind a NUL");
  return refused;
}

/// What the framer makes of a stream of bytes.
Json stream_of(std::string_view what, const Bytes& bytes) {
  protocol::Framer framer;
  Json bodies = Json::array();
  for (const std::uint8_t byte : bytes)
    if (const auto body = framer.push(byte)) bodies.push_back(hex(*body));
  const protocol::FrameCounts& counts = framer.counts();
  return {{"what", what},
          {"bytes", hex(bytes)},
          {"bodies", bodies},
          {"counts",
           {{"good", counts.good},
            {"bad_crc", counts.bad_crc},
            {"bad_cobs", counts.bad_cobs},
            {"oversize", counts.oversize},
            {"undersize", counts.undersize}}}};
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// A body of 256 bytes, none of them 0, is the longest that COBS has to split.
Bytes longest_frame() {
  const Bytes body(protocol::kMaxBody, 0x55);
  std::array<std::uint8_t, protocol::kMaxFrame> frame{};
  const std::size_t size = protocol::encode_frame(body, frame);
  return {frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size)};
}

Json streams() {
  const protocol::Frame frame(protocol::Velocity{250'000, -1}, 7);
  const Bytes good(frame.bytes().begin(), frame.bytes().end());
  Bytes damaged = good;
  damaged[4] ^= 1U;
  return {
      stream_of("a frame", good),
      stream_of("noise, the end of whatever it was, two frames", joined({{1, 2, 3, 0}, good, {0, 0}, good})),
      stream_of("a flipped bit", joined({damaged, good})),
      stream_of("half a frame", joined({Bytes(good.begin(), good.begin() + 6), {0}, good})),
      stream_of("the longest body", longest_frame()),
      stream_of("too long, then a frame", joined({Bytes(600, 7), {0}, good})),
      stream_of("shorter than a header", {1, 0, 2, 9, 0})};
}

}  // namespace

std::string vectors_text() {
  Json vectors = Json::array();
  visit_messages([&]<Message M>() { add_vectors<M>(vectors); });
  const Json table{{"protocol_version", protocol::kProtocolVersion},
                   {"messages", vectors},
                   {"refused", refused_bodies()},
                   {"streams", streams()}};
  // One line for each entry, so that a change of the schema shows as the lines of its message.
  std::string text = "{\"protocol_version\": " + std::to_string(protocol::kProtocolVersion);
  for (const char* part : {"messages", "refused", "streams"}) {
    text += ",\n\"" + std::string(part) + "\": [";
    for (const char* comma = "\n"; const Json& entry : table[part]) {
      text += comma + entry.dump();
      comma = ",\n";
    }
    text += "\n]";
  }
  return text + "}\n";
}

}  // namespace astro::python
