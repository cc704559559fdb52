#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "common/base/result.hpp"
#include "common/base/text.hpp"
#include "common/protocol/enums.hpp"
#include "common/protocol/field.hpp"

/// Identification, and the two general replies.
namespace astro::protocol {

/// Increases with every change of the schema, including new enumeration values. Hello, HelloReply and
/// ErrorReply keep their layout in all versions, so that peers of different versions can say so.
inline constexpr std::uint16_t kProtocolVersion = 5;

struct Ack {
  static constexpr std::uint8_t kId = 0x7E;
  static constexpr std::string_view kName = "Ack";
  static constexpr std::string_view kDoc = "The request was carried out, or is under way.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const Ack&) const = default;
};

struct ErrorReply {
  ErrorCode code{};
  std::uint16_t detail = 0;

  static constexpr std::uint8_t kId = 0x7F;
  static constexpr std::string_view kName = "ErrorReply";
  static constexpr std::string_view kDoc = "The request was refused and has changed nothing. Layout frozen.";
  static constexpr std::tuple kFields{
      Field{&ErrorReply::code, "code", "", "why"},
      Field{&ErrorReply::detail, "detail", "", "as the code's meaning says, otherwise 0"},
  };
  bool operator==(const ErrorReply&) const = default;
};

/// What a request gets: its reply, or the reason why it was refused.
template <class Reply>
using Answer = Result<Reply, ErrorReply>;

struct HelloReply {
  std::uint16_t protocol_version = kProtocolVersion;
  std::uint8_t fw_major = 0;
  std::uint8_t fw_minor = 0;
  std::uint8_t fw_patch = 0;
  std::array<std::uint8_t, 16> unique_id{};
  Text<24> board{};
  Text<24> robot_name{};
  std::uint16_t parameter_count = 0;
  std::uint16_t tick_hz = 0;

  static constexpr std::uint8_t kId = 0x81;
  static constexpr std::string_view kName = "HelloReply";
  static constexpr std::string_view kDoc = "Identifies the robot. Layout frozen.";
  static constexpr std::tuple kFields{
      Field{&HelloReply::protocol_version, "protocol_version", "", "the robot's version"},
      Field{&HelloReply::fw_major, "fw_major", "", "firmware version"},
      Field{&HelloReply::fw_minor, "fw_minor", "", "firmware version"},
      Field{&HelloReply::fw_patch, "fw_patch", "", "firmware version"},
      Field{&HelloReply::unique_id, "unique_id", "",
            "differs from every other robot's; the same at every start"},
      Field{&HelloReply::board, "board", "", "name of the board that the firmware was built for"},
      Field{&HelloReply::robot_name, "robot_name", "", "the parameter robot_name"},
      Field{&HelloReply::parameter_count, "parameter_count", "",
            "the indices of GetParameterInfo are less than this"},
      Field{&HelloReply::tick_hz, "tick_hz", "Hz", "rate of the control tick"},
  };
  bool operator==(const HelloReply&) const = default;
};

struct Hello {
  std::uint16_t protocol_version = kProtocolVersion;

  using Reply = HelloReply;
  static constexpr std::uint8_t kId = 0x01;
  static constexpr std::string_view kName = "Hello";
  static constexpr std::string_view kDoc =
      "Asks the robot to identify itself; answered whatever the version. Layout frozen.";
  static constexpr std::tuple kFields{
      Field{&Hello::protocol_version, "protocol_version", "", "the host's version"},
  };
  bool operator==(const Hello&) const = default;
};

struct Pong {
  std::uint64_t device_time_us = 0;

  static constexpr std::uint8_t kId = 0x82;
  static constexpr std::string_view kName = "Pong";
  static constexpr std::string_view kDoc = "The robot's clock when it answered.";
  static constexpr std::tuple kFields{
      Field{&Pong::device_time_us, "device_time_us", "us", "since power-on"},
  };
  bool operator==(const Pong&) const = default;
};

struct Ping {
  using Reply = Pong;
  static constexpr std::uint8_t kId = 0x02;
  static constexpr std::string_view kName = "Ping";
  static constexpr std::string_view kDoc = "Reads the clock and keeps a drive alive.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const Ping&) const = default;
};

struct Reboot {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x14;
  static constexpr std::string_view kName = "Reboot";
  static constexpr std::string_view kDoc = "Opens the bridges, acknowledges, and restarts.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const Reboot&) const = default;
};

struct EnterBootloader {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x15;
  static constexpr std::string_view kName = "EnterBootloader";
  static constexpr std::string_view kDoc = "Opens the bridges, acknowledges, and waits for new firmware.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const EnterBootloader&) const = default;
};

}  // namespace astro::protocol
