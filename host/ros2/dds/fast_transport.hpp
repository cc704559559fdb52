#pragma once

#include <fastdds/rtps/transport/TransportDescriptorInterface.h>

#include <atomic>
#include <memory>

namespace astro::ros2::dds {

/// Until it is opened, what is sent or comes is dropped.
class Gate {
 public:
  void open() { open_ = true; }
  bool is_open() const { return open_; }

 private:
  std::atomic<bool> open_ = false;
};

/// UDP over IPv4. Nothing is sent or read before the gate opens, and of what comes Fast DDS reads what is sound
/// (`rtps_check.hpp`).
///
/// Fast DDS 2.9 announces a participant and only then begins to receive. On this computer the answer comes within a fraction
/// of a millisecond and would be lost, and CycloneDDS answers a second time only after 1 s. With the gate shut until the
/// participant has been made, it is the announcement after it that is answered.
///
/// `here_alone`: datagrams of other computers are dropped unread, and none is sent to them. The sockets are bound to all
/// interfaces all the same, because a CycloneDDS that uses a network card, as it does by default, sends nothing to 127.0.0.1.
/// Linux itself drops what comes from outside under an address of this computer.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> gated_udp(
    bool here_alone, std::shared_ptr<const Gate> gate);

}  // namespace astro::ros2::dds
