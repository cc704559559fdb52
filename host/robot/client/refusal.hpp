#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/protocol/enums.hpp"
#include "host/base/error.hpp"

namespace astro::robot {

/// The robot answered a request with ErrorReply: it was not carried out and has changed nothing.
class RobotRefused : public Error {
 public:
  /// `what` is the request's name, or "c_R = 1.7 (AddSegment)": what stands behind "the robot refused".
  /// `why` is a clause for what this very request made the robot refuse; "": what the code says for all.
  RobotRefused(std::string_view what, protocol::ErrorCode code, std::uint16_t detail,
               std::string_view why = {});

  protocol::ErrorCode code() const { return code_; }

  /// As protocol::meaning(code()) says: a parameter's id, a fault, a version; else 0.
  std::uint16_t detail() const { return detail_; }

 private:
  protocol::ErrorCode code_;
  std::uint16_t detail_;
};

/// "under_voltage, stall" for a mask of latched faults.
std::string fault_names(std::uint32_t mask);

}  // namespace astro::robot
