#pragma once

#include <fastdds/rtps/transport/TransportDescriptorInterface.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>

#include "host/live/dds/rtps_compatibility.hpp"

namespace astro::dds {

/// Until it is opened, what is sent or comes is dropped.
class Gate {
 public:
  void open() { open_ = true; }
  bool is_open() const { return open_; }

 private:
  std::atomic<bool> open_ = false;
};

/// Which readers of others have acknowledged anything of which of our writers: of those that are expected, so that strangers
/// cannot fill it. Threads of Fast DDS note it, and others ask.
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

/// UDP over IPv4. Nothing is sent or read before the gate opens, and of what comes Fast DDS reads what is sound
/// (`rtps_check.hpp`), changed where it would not understand it (`rtps_compatibility.hpp`).
///
/// To others it sends by unicast alone: after the gate has opened, no multicast address of theirs is taken. Fast DDS 2.9 sends to
/// such an address as soon as two readers share one, as all of CycloneDDS do, and ends the program if it has not opened it.
///
/// Fast DDS 2.9 announces a participant and only then begins to receive. On this computer the answer comes within a fraction
/// of a millisecond and would be lost, and CycloneDDS answers a second time only after 1 s. With the gate shut until the
/// participant has been made, it is the announcement after it that is answered.
///
/// `here_alone`: datagrams of other computers are dropped unread, and none is sent to them. The sockets are bound to all
/// interfaces all the same, because a CycloneDDS that uses a network card, as it does by default, sends nothing to 127.0.0.1.
/// Linux itself drops what comes from outside under an address of this computer.
std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> gated_udp(
    bool here_alone, std::shared_ptr<const Gate> gate, std::shared_ptr<AcknowledgedBy> acknowledged);

}  // namespace astro::dds
