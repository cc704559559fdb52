#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/protocol/messages.hpp"

namespace astro {

/// The sender of a request: the program that has the port open, or an onlooker that shares the port with it.
struct HostId {
  static constexpr int kNobody = -1;

  int port = kNobody;
  bool onlooker = false;
  bool operator==(const HostId&) const = default;
};

/// Which host drives: the last one whose Arm or motion request was carried out. Only its requests are a sign
/// of life that keeps a drive going: neither those of an onlooker nor those of a host at another port.
///
/// Pause and Resume come from anybody and do not change who drives: a host that resumes a path does not mean
/// to keep it alive. If the host that drives is gone by then, the path ends by the command time-out.
class DrivingHost {
 public:
  bool is(const HostId& host) const { return host == host_; }

  /// A request has arrived. True if it is a sign of life of the host that drives. A Hello at that host's port
  /// means that a new program has opened the port, so the one that drove is gone.
  bool request_arrived(const HostId& from, std::uint8_t message) {
    if (message == protocol::Hello::kId) {
      if (!from.onlooker && from.port == host_.port) host_ = {};
      return false;
    }
    return from == host_;
  }

  /// A request was carried out. True if its sender drives from now on.
  bool request_carried_out(const HostId& from, std::uint8_t message) {
    constexpr std::array kDriving{protocol::Arm::kId, protocol::Velocity::kId, protocol::WheelVoltage::kId,
                                  protocol::AddSegment::kId};
    if (std::find(kDriving.begin(), kDriving.end(), message) == kDriving.end()) return false;
    host_ = from;
    return true;
  }

 private:
  HostId host_;
};

}  // namespace astro
