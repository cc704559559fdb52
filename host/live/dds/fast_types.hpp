#pragma once

#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/common/InstanceHandle.h>
#include <fastdds/rtps/common/SampleIdentity.h>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <string>
#include <vector>

#include "host/live/dds/participant.hpp"

/// Converts between our types and those of Fast DDS.
namespace astro::dds {

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

inline constexpr std::uint32_t kLargestSample = 1 << 20;

Guid to_guid(const rtps::GUID_t& from);
Guid to_guid(const rtps::InstanceHandle_t& handle);
SampleId to_sample_id(const rtps::SampleIdentity& from);
rtps::SampleIdentity from_sample_id(const SampleId& from);
std::vector<rtps::octet> octets(const std::string& text);

/// What Fast DDS passes on as a sample: bytes that are sent, or bytes that were received.
struct Payload {
  ByteView out;
  Bytes in;
};

/// A type of which Fast DDS knows only the name. It has no type information, because newer versions of Fast DDS compare that.
/// A sample of more than kLargestSample is not handed out.
class OpaqueType : public fast::TopicDataType {
 public:
  explicit OpaqueType(const std::string& name);

  bool serialize(void* data, rtps::SerializedPayload_t* into) override;
  bool deserialize(rtps::SerializedPayload_t* from, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override;
  void deleteData(void* data) override;
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override;
};

}  // namespace astro::dds
