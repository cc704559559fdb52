#pragma once

#include <fastdds/rtps/transport/TransportDescriptorInterface.h>

#include <atomic>
#include <memory>

namespace astro::ros2::dds {

/// Until it is opened, what is sent is dropped.
class Gate {
 public:
  void open() { open_ = true; }
  bool is_open() const { return open_; }

 private:
  std::atomic<bool> open_ = false;
};

/// UDP over IPv4, on the loopback interface alone or on all. Nothing is sent before the gate opens.
///
/// Fast DDS 2.9 announces a participant and only then begins to receive. On this computer the answer comes within a fraction
/// of a millisecond and would be lost, and CycloneDDS answers a second time only after 1 s. With the gate shut until the
/// participant has been made, it is the announcement after it that is answered.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> gated_udp(
    bool loopback_alone, std::shared_ptr<const Gate> gate);

}  // namespace astro::ros2::dds
