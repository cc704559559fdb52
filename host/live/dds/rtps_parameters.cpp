#include "host/live/dds/rtps_parameters.hpp"

#include <algorithm>
#include <iterator>

#include "host/live/dds/rtps_fields.hpp"

namespace astro::dds {
namespace {

constexpr std::uint16_t kSentinel = 0x0001;
constexpr std::size_t kLocator = 24, kGuid = 16, kDuration = 8, kWord = 4;

enum class Value { any, text, texts, text_pairs, octets, shorts, token };

struct Parameter {
  std::uint16_t id;
  std::size_t shortest;
  Value value = Value::any;
};

constexpr Parameter kParameters[] = {
    {0x0002, kDuration},                 // participant's lease
    {0x0004, kDuration},                 // time-based filter
    {0x0005, kWord, Value::text},        // topic name
    {0x0006, kWord},                     // ownership strength
    {0x0007, kWord, Value::text},        // type name
    {0x000f, kWord},                     // domain
    {0x0015, kWord},                     // protocol version
    {0x0016, kWord},                     // vendor
    {0x001a, kWord + kDuration},         // reliability
    {0x001b, kWord + kDuration},         // liveliness
    {0x001d, kWord},                     // durability
    {0x001e, kDuration + 5 * kWord},     // durability service
    {0x001f, kWord},                     // ownership
    {0x0021, kWord},                     // presentation
    {0x0023, kDuration},                 // deadline
    {0x0025, kWord},                     // destination order
    {0x0027, kDuration},                 // latency budget
    {0x0029, kWord, Value::texts},       // partition
    {0x002b, kDuration},                 // lifespan
    {0x002c, kWord, Value::octets},      // user data
    {0x002d, kWord, Value::octets},      // group data
    {0x002e, kWord, Value::octets},      // topic data
    {0x002f, kLocator},                  // unicast locator
    {0x0030, kLocator},                  // multicast locator
    {0x0031, kLocator},                  // default unicast locator
    {0x0032, kLocator},                  // metatraffic unicast locator
    {0x0033, kLocator},                  // metatraffic multicast locator
    {0x0034, kWord},                     // participant's manual liveliness count
    {0x0040, kDuration},                 // history
    {0x0041, 3 * kWord},                 // resource limits
    {0x0043, kWord},                     // expects inline QoS
    {0x0048, kLocator},                  // default multicast locator
    {0x0049, kWord},                     // transport priority
    {0x0050, kGuid},                     // participant's identifier
    {0x0052, kGuid},                     // group's identifier
    {0x0053, kWord},                     // group's entity
    {0x0058, kWord},                     // built-in endpoints
    {0x0059, kWord, Value::text_pairs},  // properties
    {0x005a, kGuid},                     // endpoint's identifier
    {0x0060, kWord},                     // largest serialized type
    {0x0062, kWord, Value::text},        // entity name
    {0x0070, kGuid},                     // key hash
    {0x0071, kWord},                     // status
    {0x0073, kWord, Value::shorts},      // representations of data
    {0x0083, 24},                        // related sample's identity
    {0x1001, kWord, Value::token},       // identity
    {0x1002, kWord, Value::token},       // permissions
    {0x800f, 24},                        // the same as eProsima numbers it
};
static_assert(std::is_sorted(std::begin(kParameters), std::end(kParameters),
                             [](const Parameter& a, const Parameter& b) { return a.id < b.id; }));

void read_text(RtpsFields& fields) {
  fields.align();
  fields.take(fields.u32());
}

void read_texts(RtpsFields& fields, std::uint64_t per_entry) {
  fields.align();
  const std::uint64_t texts = per_entry * fields.u32();
  for (std::uint64_t i = 0; i < texts && fields.ok(); ++i) read_text(fields);
}

/// A text, properties and binary properties. In CDR a text has the form of a sequence of bytes.
void read_token(RtpsFields& fields) {
  read_text(fields);
  read_texts(fields, 2);
  read_texts(fields, 2);
}

bool is_a(Value value, RtpsFields fields) {
  switch (value) {
    case Value::any:
      break;
    case Value::text:
    case Value::octets:
      read_text(fields);
      break;
    case Value::texts:
      read_texts(fields, 1);
      break;
    case Value::text_pairs:
      read_texts(fields, 2);
      break;
    case Value::shorts:
      fields.take(std::size_t{2} * fields.u32());
      break;
    case Value::token:
      read_token(fields);
      break;
  }
  return fields.ok();
}

bool has_its_value(std::uint16_t id, ByteView bytes, std::endian order) {
  const auto* const found = std::lower_bound(std::begin(kParameters), std::end(kParameters), id,
                                             [](const Parameter& p, std::uint16_t of) { return p.id < of; });
  if (found == std::end(kParameters) || found->id != id) return true;
  return bytes.size() >= found->shortest && is_a(found->value, RtpsFields(bytes, order));
}

}  // namespace

std::optional<std::size_t> parameter_list_size(ByteView bytes, std::endian order) {
  RtpsFields fields(bytes, order);
  while (fields.ok()) {
    const std::uint16_t id = fields.u16(), size = fields.u16();
    if (!fields.ok()) break;
    if (id == kSentinel) return fields.offset();  // whatever its length says
    const ByteView value = fields.take(size);
    if (size % 4 != 0 || !fields.ok() || !has_its_value(id, value, order)) break;
  }
  return std::nullopt;
}

bool is_parameter_list_payload(ByteView payload) {
  constexpr std::size_t kHead = 4;  // representation and options
  constexpr std::uint8_t kBigEndianList = 2, kLittleEndianList = 3;
  if (payload.size() < kHead || payload[0] != 0) return false;
  if (payload[1] != kBigEndianList && payload[1] != kLittleEndianList) return false;
  const auto order = payload[1] == kLittleEndianList ? std::endian::little : std::endian::big;
  const ByteView list = payload.subspan(kHead);
  return parameter_list_size(list, order) == list.size();
}

}  // namespace astro::dds
