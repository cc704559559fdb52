#pragma once

#include <string_view>

#include "common/protocol/messages.hpp"
#include "host/robot/sharing/relay_messages.hpp"
#include "tests/common/protocol/enum_name.hpp"

/// What the Python package speaks: the robot's protocol, and the messages of programs that share a port.
namespace astro::python {

using protocol::Message;
using protocol::MessageList;
using protocol::Named;

using PortReplies = MessageList<robot::PortUsers>;
using PortRequests = MessageList<robot::GetPortUsers>;
using PortEvents = MessageList<robot::Welcome, robot::Farewell>;

template <class T>
constexpr std::string_view enum_name() {
  if constexpr (std::is_same_v<T, robot::FarewellReason>) return "FarewellReason";
  return protocol::enum_name<T>();
}

/// Calls f.template operator()<M>() for each message, those first that others name.
template <class F>
void visit_messages(F&& f) {
  protocol::Replies::visit(f);
  PortReplies::visit(f);
  protocol::Requests::visit(f);
  PortRequests::visit(f);
  protocol::Events::visit(f);
  PortEvents::visit(f);
}

}  // namespace astro::python
