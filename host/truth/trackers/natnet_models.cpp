#include "host/truth/trackers/natnet_models.hpp"

namespace astro::truth::natnet {
namespace {

constexpr std::int32_t kMarkerSet = 0, kRigidBody = 1;

void skip_texts(ByteCursor& cursor) {
  const auto count = cursor.number<std::int32_t>();
  for (std::int32_t i = 0; i < count && cursor.ok(); ++i) take_text(cursor);
}

void take_rigid_body(ByteCursor& cursor, Version version, BodyNames& names) {
  const std::string name(take_text(cursor));
  const auto id = cursor.number<std::int32_t>();
  cursor.take(4 + 12);  // the parent, and the offset from it
  const auto markers = cursor.number<std::int32_t>();
  cursor.take(markers < 0 ? cursor.left() + 1 : std::uint64_t{16} * static_cast<std::uint32_t>(markers));
  if (version >= Version{4, 0})
    for (std::int32_t i = 0; i < markers && cursor.ok(); ++i) take_text(cursor);
  if (cursor.ok()) names[id] = name;
}

}  // namespace

std::optional<BodyNames> body_names_in(ByteView payload, Version version) {
  ByteCursor cursor(payload);
  BodyNames names;
  const auto count = cursor.number<std::int32_t>();
  if (!cursor.ok() || count < 0) return std::nullopt;
  for (std::int32_t i = 0; i < count && cursor.ok(); ++i) {
    const auto kind = cursor.number<std::int32_t>();
    if (version >= Version{4, 1}) {
      const auto size = cursor.number<std::int32_t>();
      ByteCursor description(cursor.take(size < 0 ? cursor.left() + 1 : static_cast<std::uint64_t>(size)));
      if (kind == kRigidBody && cursor.ok()) take_rigid_body(description, version, names);
    } else if (kind == kRigidBody) {
      take_rigid_body(cursor, version, names);
    } else if (kind == kMarkerSet) {
      take_text(cursor);
      skip_texts(cursor);
    } else {
      break;
    }
  }
  return names;
}

Bytes payload_of(const BodyNames& names, Version version) {
  Bytes bytes;
  append(bytes, static_cast<std::int32_t>(names.size()));
  for (const auto& [id, name] : names) {
    Bytes description;
    append_text(description, name);
    append(description, id);
    append(description, std::int32_t{-1});
    description.resize(description.size() + 12 + 4);  // no offset, no markers
    append(bytes, kRigidBody);
    if (version >= Version{4, 1}) append(bytes, static_cast<std::int32_t>(description.size()));
    append(bytes, description);
  }
  return bytes;
}

}  // namespace astro::truth::natnet
