#pragma once

#include <span>
#include <string>

#include "common/protocol/fault_log.hpp"
#include "host/commands/shared/robot_view.hpp"

namespace astro::commands {

/// The fault log as text: a table, the newest first, or a sentence if it is empty.
std::string fault_log_table(std::span<const protocol::FaultLogEntry> entries);

Json fault_log_json(std::span<const protocol::FaultLogEntry> entries);

}  // namespace astro::commands
