#pragma once

#include <fastdds/rtps/transport/TransportDescriptorInterface.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>

#include "host/live/dds/rtps_compatibility.hpp"

namespace astro::dds {

/// Until the gate is opened, everything that is sent or received is dropped.
class Gate {
 public:
  void open() { open_ = true; }
  bool is_open() const { return open_; }

 private:
  std::atomic<bool> open_ = false;
};

/// Which readers of others have acknowledged anything to which of our writers. Only expected pairs are noted, so that
/// strangers cannot fill the memory. Threads of Fast DDS note them, and other threads ask.
class AcknowledgedBy {
 public:
  void expect(const Acknowledgement& which) {
    const std::lock_guard lock(mutex_);
    noted_.emplace(which, false);
  }
  void forget(const Acknowledgement& which) {
    const std::lock_guard lock(mutex_);
    noted_.erase(which);
  }
  void note(const Acknowledgement& which) {
    const std::lock_guard lock(mutex_);
    if (const auto found = noted_.find(which); found != noted_.end()) found->second = true;
  }
  bool has(const Acknowledgement& which) const {
    const std::lock_guard lock(mutex_);
    const auto found = noted_.find(which);
    return found != noted_.end() && found->second;
  }

 private:
  mutable std::mutex mutex_;
  std::map<Acknowledgement, bool> noted_;
};

/// UDP over IPv4. Nothing is sent or read before the gate opens. Fast DDS gets only the sound part of each datagram
/// (`rtps_check.hpp`), changed where it would not understand it (`rtps_compatibility.hpp`).
///
/// It sends to others only by unicast: after the gate has opened, multicast addresses that they announce are refused. Fast
/// DDS 2.9 would send to such an address as soon as two readers share it, as all readers of CycloneDDS do, and would end the
/// program if it has not opened that address.
///
/// Fast DDS 2.9 announces a participant and only then begins to receive. On this computer the answer comes within a fraction
/// of a millisecond and would be lost, and CycloneDDS answers a second time only after 1 s. So the gate stays shut until the
/// participant has been made, and others answer an announcement that comes later.
///
/// `here_alone`: datagrams of other computers are dropped unread, and none is sent to them. The sockets are bound to all
/// interfaces all the same, because a CycloneDDS that uses a network card, as it does by default, sends nothing to 127.0.0.1.
/// Linux itself drops what comes from outside under an address of this computer.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> gated_udp(
    bool here_alone, std::shared_ptr<const Gate> gate, std::shared_ptr<AcknowledgedBy> acknowledged);

}  // namespace astro::dds
