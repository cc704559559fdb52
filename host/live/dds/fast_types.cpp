#include "host/live/dds/fast_types.hpp"

#include <algorithm>

namespace astro::dds {
namespace {

constexpr std::uint32_t kFirstAllocation = 1024;  // grows with larger samples

rtps::GUID_t from_guid(const Guid& from) {
  rtps::GUID_t guid;
  std::copy_n(from.bytes.begin(), 12, guid.guidPrefix.value);
  std::copy_n(from.bytes.begin() + 12, 4, guid.entityId.value);
  return guid;
}

}  // namespace

Guid to_guid(const rtps::GUID_t& from) {
  Guid guid;
  std::copy_n(from.guidPrefix.value, 12, guid.bytes.begin());
  std::copy_n(from.entityId.value, 4, guid.bytes.begin() + 12);
  return guid;
}

Guid to_guid(const rtps::InstanceHandle_t& handle) {
  rtps::GUID_t guid;
  rtps::iHandle2GUID(guid, handle);
  return to_guid(guid);
}

SampleId to_sample_id(const rtps::SampleIdentity& from) {
  return {to_guid(from.writer_guid()), static_cast<std::int64_t>(from.sequence_number().to64long())};
}

rtps::SampleIdentity from_sample_id(const SampleId& from) {
  rtps::SampleIdentity identity;
  identity.writer_guid(from_guid(from.writer));
  identity.sequence_number(rtps::SequenceNumber_t(static_cast<std::int32_t>(from.number >> 32),
                                                  static_cast<std::uint32_t>(from.number)));
  return identity;
}

std::vector<rtps::octet> octets(const std::string& text) { return {text.begin(), text.end()}; }

OpaqueType::OpaqueType(const std::string& name) {
  setName(name.c_str());
  m_typeSize = kFirstAllocation;
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool OpaqueType::serialize(void* data, rtps::SerializedPayload_t* into) {
  const ByteView bytes = static_cast<Payload*>(data)->out;
  if (bytes.size() > into->max_size) return false;
  std::copy(bytes.begin(), bytes.end(), into->data);
  into->length = static_cast<std::uint32_t>(bytes.size());
  into->encapsulation = CDR_LE;
  return true;
}

bool OpaqueType::deserialize(rtps::SerializedPayload_t* from, void* data) {
  if (from->length > kLargestSample) return false;
  static_cast<Payload*>(data)->in.assign(from->data, from->data + from->length);
  return true;
}

std::function<std::uint32_t()> OpaqueType::getSerializedSizeProvider(void* data) {
  return [size = static_cast<std::uint32_t>(static_cast<Payload*>(data)->out.size())] { return size; };
}

void* OpaqueType::createData() { return new Payload; }  // Fast DDS owns it
void OpaqueType::deleteData(void* data) { delete static_cast<Payload*>(data); }
bool OpaqueType::getKey(void*, rtps::InstanceHandle_t*, bool) { return false; }

}  // namespace astro::dds
