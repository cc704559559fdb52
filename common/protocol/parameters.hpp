#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "common/base/text.hpp"
#include "common/protocol/enums.hpp"
#include "common/protocol/field.hpp"
#include "common/protocol/session.hpp"

/// Reading and changing parameters: open the staging area, stage any number of values, then commit them as
/// one set.
///
/// The staging area belongs to one session. RevertParameters and DefaultParameters open it for the port that
/// asks and take it from any other port; a Hello at its owner's port closes it. StageParameter,
/// CommitParameters and ApplyParameters from another port are refused (staging_lost), so a set never mixes
/// the values of two programs.
namespace astro::protocol {

struct ParameterInfo {
  std::uint16_t id = 0;
  Text<24> name{};
  Text<8> unit{};
  ParameterKind kind{};
  std::int8_t scale_exponent = 0;
  std::int32_t minimum = 0;
  std::int32_t maximum = 0;
  std::int32_t default_value = 0;
  Text<120> doc{};

  static constexpr std::uint8_t kId = 0x8B;
  static constexpr std::string_view kName = "ParameterInfo";
  static constexpr std::string_view kDoc =
      "Everything that a host must know to show and set a parameter it has never seen.";
  static constexpr std::tuple kFields{
      Field{&ParameterInfo::id, "id", "",
            "the parameter's name on the wire, the same in all firmware versions"},
      Field{&ParameterInfo::name, "name", "", "the parameter's name for people"},
      Field{&ParameterInfo::unit, "unit", "", "of the scaled value"},
      Field{&ParameterInfo::kind, "kind", "", "how a raw number becomes a value"},
      Field{&ParameterInfo::scale_exponent, "scale_exponent", "",
            "value = raw * 2^exponent or raw * 10^exponent"},
      Field{&ParameterInfo::minimum, "minimum", "raw", "least allowed"},
      Field{&ParameterInfo::maximum, "maximum", "raw", "greatest allowed"},
      Field{&ParameterInfo::default_value, "default_value", "raw", "factory default"},
      Field{&ParameterInfo::doc, "doc", "", "one sentence"},
  };
  bool operator==(const ParameterInfo&) const = default;
};

struct GetParameterInfo {
  std::uint16_t index = 0;

  using Reply = ParameterInfo;
  static constexpr std::uint8_t kId = 0x0B;
  static constexpr std::string_view kName = "GetParameterInfo";
  static constexpr std::string_view kDoc = "Asks for one row of the parameter table.";
  static constexpr std::tuple kFields{
      Field{&GetParameterInfo::index, "index", "", "0 to HelloReply.parameter_count - 1"},
  };
  bool operator==(const GetParameterInfo&) const = default;
};

struct ParameterValue {
  std::uint16_t id = 0;
  std::int32_t active = 0;
  std::int32_t staged = 0;
  Text<24> active_text{};
  Text<24> staged_text{};

  static constexpr std::uint8_t kId = 0x8C;
  static constexpr std::string_view kName = "ParameterValue";
  static constexpr std::string_view kDoc =
      "A parameter's value: the one in force and the one that this session has staged.";
  static constexpr std::tuple kFields{
      Field{&ParameterValue::id, "id", "", "as in ParameterInfo"},
      Field{&ParameterValue::active, "active", "raw", "in force; 0 for a text"},
      Field{&ParameterValue::staged, "staged", "raw",
            "staged by this session, otherwise as active; 0 for a text"},
      Field{&ParameterValue::active_text, "active_text", "", "in force; empty unless kind is text"},
      Field{&ParameterValue::staged_text, "staged_text", "",
            "staged by this session, otherwise as active; empty unless kind is text"},
  };
  bool operator==(const ParameterValue&) const = default;
};

struct GetParameter {
  std::uint16_t id = 0;

  using Reply = ParameterValue;
  static constexpr std::uint8_t kId = 0x0C;
  static constexpr std::string_view kName = "GetParameter";
  static constexpr std::string_view kDoc = "Asks for a parameter's value.";
  static constexpr std::tuple kFields{
      Field{&GetParameter::id, "id", "", "as in ParameterInfo"},
  };
  bool operator==(const GetParameter&) const = default;
};

struct StageParameter {
  std::uint16_t id = 0;
  std::int32_t value = 0;
  Text<24> text{};

  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x0D;
  static constexpr std::string_view kName = "StageParameter";
  static constexpr std::string_view kDoc =
      "Stages a value in the area that this session has opened; nothing changes before CommitParameters.";
  static constexpr std::tuple kFields{
      Field{&StageParameter::id, "id", "", "as in ParameterInfo"},
      Field{&StageParameter::value, "value", "raw", "0 for a text"},
      Field{&StageParameter::text, "text", "", "empty unless kind is text"},
  };
  bool operator==(const StageParameter&) const = default;
};

struct CommitParameters {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x0E;
  static constexpr std::string_view kName = "CommitParameters";
  static constexpr std::string_view kDoc =
      "Validates the staged set as a whole and puts it in force. Writes the values that were staged in this "
      "area to flash: all of them or none.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const CommitParameters&) const = default;
};

struct RevertParameters {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x0F;
  static constexpr std::string_view kName = "RevertParameters";
  static constexpr std::string_view kDoc =
      "Opens the staging area for this session, with the values in force.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const RevertParameters&) const = default;
};

struct DefaultParameters {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x10;
  static constexpr std::string_view kName = "DefaultParameters";
  static constexpr std::string_view kDoc =
      "Opens the staging area for this session, with the factory defaults.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const DefaultParameters&) const = default;
};

struct ApplyParameters {
  using Reply = Ack;
  static constexpr std::uint8_t kId = 0x1A;
  static constexpr std::string_view kName = "ApplyParameters";
  static constexpr std::string_view kDoc =
      "Puts the staged set in force until the next restart, without making it part of the next commit. While "
      "the robot drives only gains may differ.";
  static constexpr std::tuple<> kFields{};
  bool operator==(const ApplyParameters&) const = default;
};

}  // namespace astro::protocol
