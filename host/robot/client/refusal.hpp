#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/protocol/enums.hpp"
#include "host/base/error.hpp"

namespace astro::robot {

/// The robot answered a request with ErrorReply: it was not carried out and has changed nothing.
class RobotRefused : public Error {
 public:
  /// `what` follows "the robot refused": the request's name, or a value as "c_R = 1.7".
  /// `why` is a clause with the reason for this particular request; "": the general meaning of the code.
  /// `values`: empty for `what` alone.
  RobotRefused(std::string_view what, protocol::ErrorCode code, std::uint16_t detail,
               std::string_view why = {}, const std::vector<std::string>& values = {});

  protocol::ErrorCode code() const { return code_; }

  /// Meaning by protocol::meaning(code()): a parameter's id, a fault, a version; else 0.
  std::uint16_t detail() const { return detail_; }

 private:
  protocol::ErrorCode code_;
  std::uint16_t detail_;
};

/// "under_voltage, stall" for a mask of latched faults.
std::string fault_names(std::uint32_t mask);

}  // namespace astro::robot
