#include "tests/host/python/messages_text.hpp"

#include <array>
#include <cstdint>
#include <set>
#include <type_traits>

#include "host/robot/client/fault_help.hpp"
#include "tests/host/python/schema.hpp"

namespace astro::python {
namespace {

using protocol::detail::each;

std::string quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
  return quoted + "\"";
}

/// How a value is declared, laid out and defaulted in Python.
struct Declared {
  std::string type, code, initial, enumeration;
};

template <std::integral T>
Declared declared(T value) {
  constexpr std::string_view kCodes = std::is_signed_v<T> ? "bhiq" : "BHIQ";
  constexpr std::size_t kIndex = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
  return {"int", std::string(1, kCodes[kIndex]), std::to_string(value), ""};
}
template <Named E>
Declared declared(E value) {
  static_assert(!enum_name<E>().empty(), "name this enumeration in schema.hpp");
  const std::string type(enum_name<E>());
  return {type, declared(std::underlying_type_t<E>{}).code,
          type + "(" + std::to_string(static_cast<int>(value)) + ")", type};
}
template <std::size_t N>
Declared declared(const std::array<std::uint8_t, N>&) {
  return {"bytes", std::to_string(N) + "s", "bytes(" + std::to_string(N) + ")", ""};
}
template <std::size_t N>
Declared declared(const Text<N>& text) {
  return {"str", std::to_string(N) + "t", quoted(text.view()), ""};
}

template <Named E>
std::string enumeration(std::string_view doc) {
  std::string text =
      "class " + std::string(enum_name<E>()) + "(IntEnum):\n    \"\"\"" + std::string(doc) + "\"\"\"\n\n";
  for (std::size_t i = 0; i < names(E{}).size(); ++i)
    text += "    " + std::string(names(E{})[i]) + " = " + std::to_string(i) + "\n";
  return text + "\n\n";
}

/// A dictionary from the values of E to what `meaning_of` says about each.
template <Named E, class F>
std::string meanings(std::string_view name, F&& meaning_of) {
  std::string text = std::string(name) + ": dict[" + std::string(enum_name<E>()) + ", str] = {\n";
  for (std::size_t i = 0; i < names(E{}).size(); ++i)
    text += "    " + std::string(enum_name<E>()) + "." + std::string(names(E{})[i]) + ": " +
            quoted(meaning_of(static_cast<E>(i))) + ",\n";
  return text + "}\n\n";
}

std::string enumerations() {
  return enumeration<protocol::Mode>(
             "What the robot is doing. In disarmed, fault and boot its bridges are open.") +
         enumeration<protocol::SegmentKind>("The shape of a segment.") +
         enumeration<protocol::SegmentOutcome>("How a segment ended.") +
         enumeration<protocol::ParameterKind>("How a parameter's raw number becomes a value.") +
         enumeration<protocol::ResetCause>("Why the processor last started.") +
         enumeration<protocol::ErrorCode>("Why a request was refused; ERROR_MEANINGS says it in words.") +
         enumeration<Fault>("A named, latched stop; FAULT_HELP says what to check.") +
         enumeration<protocol::GyroState>("Whether the gyro counts, or why it does not.") +
         enumeration<robot::FarewellReason>("Why the program that holds the port ended a connection.") +
         meanings<protocol::ErrorCode>("ERROR_MEANINGS", [](auto code) { return protocol::meaning(code); }) +
         meanings<Fault>("FAULT_HELP", [](auto fault) { return robot::fault_help(fault); }) +
         meanings<robot::FarewellReason>("FAREWELL_FACTS", [](auto reason) { return robot::fact(reason); });
}

/// The modes in which the motors drive the wheels.
std::string powered_modes() {
  std::string text = "POWERED_MODES = frozenset({";
  for (std::size_t i = 0; i < protocol::kModeNames.size(); ++i)
    if (protocol::gives_power(static_cast<protocol::Mode>(i)))
      text += (text.ends_with('{') ? "Mode." : ", Mode.") + std::string(protocol::kModeNames[i]);
  return text + "})\n\n";
}

/// "        name: unit; meaning"
template <class Entry>
std::string explained(const Entry& field, const std::string& unit) {
  return "        " + std::string(field.name) + ": " + unit +
         (unit.empty() || field.doc.empty() ? "" : "; ") + std::string(field.doc) + "\n";
}

template <class T>
std::string record_name(const T&) {
  if constexpr (std::is_same_v<T, protocol::PoseGroup>) return "PoseGroup";
  if constexpr (std::is_same_v<T, protocol::CountsGroup>) return "CountsGroup";
  if constexpr (std::is_same_v<T, protocol::TwistGroup>) return "TwistGroup";
  if constexpr (std::is_same_v<T, protocol::WheelGroup>) return "WheelGroup";
  if constexpr (std::is_same_v<T, protocol::DutyGroup>) return "DutyGroup";
  if constexpr (std::is_same_v<T, protocol::BatteryGroup>) return "BatteryGroup";
  if constexpr (std::is_same_v<T, protocol::StateGroup>) return "StateGroup";
  if constexpr (std::is_same_v<T, protocol::PathGroup>) return "PathGroup";
  if constexpr (std::is_same_v<T, protocol::FusedGroup>) return "FusedGroup";
}

/// The parts of a class that follow from its fields.
struct Body {
  std::string docs, layout, members;
};

template <class M>
Body body_of(const M& message) {
  Body body;
  each<false, M>([&](const auto& field) {
    const Declared value = declared(message.*field.member);
    body.docs += explained(field, std::string(field.unit));
    body.layout += "        Field(" + quoted(field.name) + ", " + quoted(value.code) +
                   (value.enumeration.empty() ? "" : ", " + value.enumeration) + "),\n";
    body.members += "    " + std::string(field.name) + ": " + value.type + " = " + value.initial + "\n";
  });
  each<true, M>([&](const auto& group) {
    const std::string record = record_name(message.*group.member);
    body.docs += explained(group, "");
    body.layout +=
        "        Group(" + quoted(group.name) + ", " + std::to_string(group.bit) + ", " + record + "),\n";
    body.members += "    " + std::string(group.name) + ": " + record + " = " + record + "()\n";
  });
  return body;
}

std::string class_text(const std::string& head, const std::string& doc, const std::string& constants,
                       const Body& body) {
  return "@dataclass(frozen=True)\nclass " + head + ":\n    \"\"\"" + doc +
         (body.docs.empty() ? "" : "\n\n    Fields:\n" + body.docs + "    ") + "\"\"\"\n\n" + constants +
         "    LAYOUT: ClassVar[Layout] = (" + (body.layout.empty() ? "" : "\n" + body.layout + "    ") +
         ")\n" + body.members + "\n\n";
}

template <Message M>
std::string message_class() {
  const std::string name(M::kName);
  std::string base = "Message", constants = "    ID: ClassVar[int] = " + std::to_string(M::kId) + "\n";
  if constexpr (protocol::Request<M>) {
    const std::string reply(M::Reply::kName);
    base = "Request[" + reply + "]";
    constants += "    REPLY: ClassVar[type[Message]] = " + reply + "\n";
  }
  return class_text(name + "(" + base + ")", std::string(M::kDoc), constants, body_of(M{}));
}

/// The records of a message's groups, each once.
template <Message M>
std::string record_classes(std::set<std::string>& written) {
  std::string text;
  each<true, M>([&](const auto& group) {
    const M message;
    const std::string name = record_name(message.*group.member);
    if (written.insert(name).second)
      text += class_text(name + "(Record)", "A group of " + std::string(M::kName) + ".", "",
                         body_of(message.*group.member));
  });
  return text;
}

constexpr std::string_view kHead =
    R"(# Written by the program python_messages from the C++ schema; the README of this room says how.
"""The messages of the robot's protocol: what is on the wire, in integers with a declared scale."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import ClassVar

from astrolabe.codec import Field, Group, Layout, Message, Record, Request

)";

}  // namespace

std::string messages_text() {
  std::string text = std::string(kHead) + "PROTOCOL_VERSION = " + std::to_string(protocol::kProtocolVersion) +
                     "\n\n\n" + enumerations() + powered_modes() + "\n";
  std::set<std::string> written;
  visit_messages([&]<Message M>() { text += record_classes<M>(written); });
  visit_messages([&]<Message M>() { text += message_class<M>(); });
  std::string all = "MESSAGES: tuple[type[Message], ...] = (\n";
  visit_messages([&]<Message M>() { all += "    " + std::string(M::kName) + ",\n"; });
  return text + all + ")\n";
}

}  // namespace astro::python
