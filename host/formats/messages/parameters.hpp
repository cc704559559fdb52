#pragma once

#include <cstddef>

#include "host/formats/messages/std.hpp"

/// The parameters of a node, and the services by which it shows and changes them: rcl_interfaces.
namespace astro::ros2::msg {

/// Only the value that `type` names counts.
struct ParameterValue {
  std::uint8_t type = 0;
  bool bool_value = false;
  std::int64_t integer_value = 0;
  double double_value = 0;
  std::string string_value;
  std::vector<std::byte> byte_array_value;
  std::vector<bool> bool_array_value;
  std::vector<std::int64_t> integer_array_value;
  std::vector<double> double_array_value;
  std::vector<std::string> string_array_value;

  static constexpr std::string_view kType = "rcl_interfaces/msg/ParameterValue";
  static constexpr std::tuple kFields{Field{&ParameterValue::type, "type"},
                                      Field{&ParameterValue::bool_value, "bool_value"},
                                      Field{&ParameterValue::integer_value, "integer_value"},
                                      Field{&ParameterValue::double_value, "double_value"},
                                      Field{&ParameterValue::string_value, "string_value"},
                                      Field{&ParameterValue::byte_array_value, "byte_array_value"},
                                      Field{&ParameterValue::bool_array_value, "bool_array_value"},
                                      Field{&ParameterValue::integer_array_value, "integer_array_value"},
                                      Field{&ParameterValue::double_array_value, "double_array_value"},
                                      Field{&ParameterValue::string_array_value, "string_array_value"}};
  bool operator==(const ParameterValue&) const = default;
};

struct Parameter {
  std::string name;
  ParameterValue value;

  static constexpr std::string_view kType = "rcl_interfaces/msg/Parameter";
  static constexpr std::tuple kFields{Field{&Parameter::name, "name"}, Field{&Parameter::value, "value"}};
  bool operator==(const Parameter&) const = default;
};

struct FloatingPointRange {
  double from_value = 0, to_value = 0, step = 0;

  static constexpr std::string_view kType = "rcl_interfaces/msg/FloatingPointRange";
  static constexpr std::tuple kFields{Field{&FloatingPointRange::from_value, "from_value"},
                                      Field{&FloatingPointRange::to_value, "to_value"},
                                      Field{&FloatingPointRange::step, "step"}};
  bool operator==(const FloatingPointRange&) const = default;
};

struct IntegerRange {
  std::int64_t from_value = 0, to_value = 0;
  std::uint64_t step = 0;

  static constexpr std::string_view kType = "rcl_interfaces/msg/IntegerRange";
  static constexpr std::tuple kFields{Field{&IntegerRange::from_value, "from_value"},
                                      Field{&IntegerRange::to_value, "to_value"},
                                      Field{&IntegerRange::step, "step"}};
  bool operator==(const IntegerRange&) const = default;
};

struct ParameterDescriptor {
  std::string name;
  std::uint8_t type = 0;
  std::string description, additional_constraints;
  bool read_only = false, dynamic_typing = false;
  std::optional<FloatingPointRange> floating_point_range;
  std::optional<IntegerRange> integer_range;

  static constexpr std::string_view kType = "rcl_interfaces/msg/ParameterDescriptor";
  static constexpr std::tuple kFields{
      Field{&ParameterDescriptor::name, "name"},
      Field{&ParameterDescriptor::type, "type"},
      Field{&ParameterDescriptor::description, "description"},
      Field{&ParameterDescriptor::additional_constraints, "additional_constraints"},
      Field{&ParameterDescriptor::read_only, "read_only"},
      Field{&ParameterDescriptor::dynamic_typing, "dynamic_typing"},
      Field{&ParameterDescriptor::floating_point_range, "floating_point_range"},
      Field{&ParameterDescriptor::integer_range, "integer_range"}};
  bool operator==(const ParameterDescriptor&) const = default;
};

struct SetParametersResult {
  bool successful = false;
  std::string reason;

  static constexpr std::string_view kType = "rcl_interfaces/msg/SetParametersResult";
  static constexpr std::tuple kFields{Field{&SetParametersResult::successful, "successful"},
                                      Field{&SetParametersResult::reason, "reason"}};
  bool operator==(const SetParametersResult&) const = default;
};

struct ListParametersResult {
  std::vector<std::string> names;
  std::vector<std::string> prefixes;

  static constexpr std::string_view kType = "rcl_interfaces/msg/ListParametersResult";
  static constexpr std::tuple kFields{Field{&ListParametersResult::names, "names"},
                                      Field{&ListParametersResult::prefixes, "prefixes"}};
  bool operator==(const ListParametersResult&) const = default;
};

struct ParameterEvent {
  Time stamp;
  std::string node;
  std::vector<Parameter> new_parameters;
  std::vector<Parameter> changed_parameters;
  std::vector<Parameter> deleted_parameters;

  static constexpr std::string_view kType = "rcl_interfaces/msg/ParameterEvent";
  static constexpr std::tuple kFields{Field{&ParameterEvent::stamp, "stamp"},
                                      Field{&ParameterEvent::node, "node"},
                                      Field{&ParameterEvent::new_parameters, "new_parameters"},
                                      Field{&ParameterEvent::changed_parameters, "changed_parameters"},
                                      Field{&ParameterEvent::deleted_parameters, "deleted_parameters"}};
  bool operator==(const ParameterEvent&) const = default;
};

struct GetParameters {
  static constexpr std::string_view kType = "rcl_interfaces/srv/GetParameters";

  struct Request {
    std::vector<std::string> names;

    static constexpr std::string_view kType = "rcl_interfaces/srv/GetParameters_Request";
    static constexpr std::tuple kFields{Field{&Request::names, "names"}};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    std::vector<ParameterValue> values;

    static constexpr std::string_view kType = "rcl_interfaces/srv/GetParameters_Response";
    static constexpr std::tuple kFields{Field{&Response::values, "values"}};
    bool operator==(const Response&) const = default;
  };
};

struct GetParameterTypes {
  static constexpr std::string_view kType = "rcl_interfaces/srv/GetParameterTypes";

  struct Request {
    std::vector<std::string> names;

    static constexpr std::string_view kType = "rcl_interfaces/srv/GetParameterTypes_Request";
    static constexpr std::tuple kFields{Field{&Request::names, "names"}};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    std::vector<std::uint8_t> types;

    static constexpr std::string_view kType = "rcl_interfaces/srv/GetParameterTypes_Response";
    static constexpr std::tuple kFields{Field{&Response::types, "types"}};
    bool operator==(const Response&) const = default;
  };
};

struct SetParameters {
  static constexpr std::string_view kType = "rcl_interfaces/srv/SetParameters";

  struct Request {
    std::vector<Parameter> parameters;

    static constexpr std::string_view kType = "rcl_interfaces/srv/SetParameters_Request";
    static constexpr std::tuple kFields{Field{&Request::parameters, "parameters"}};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    std::vector<SetParametersResult> results;

    static constexpr std::string_view kType = "rcl_interfaces/srv/SetParameters_Response";
    static constexpr std::tuple kFields{Field{&Response::results, "results"}};
    bool operator==(const Response&) const = default;
  };
};

struct SetParametersAtomically {
  static constexpr std::string_view kType = "rcl_interfaces/srv/SetParametersAtomically";

  struct Request {
    std::vector<Parameter> parameters;

    static constexpr std::string_view kType = "rcl_interfaces/srv/SetParametersAtomically_Request";
    static constexpr std::tuple kFields{Field{&Request::parameters, "parameters"}};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    SetParametersResult result;

    static constexpr std::string_view kType = "rcl_interfaces/srv/SetParametersAtomically_Response";
    static constexpr std::tuple kFields{Field{&Response::result, "result"}};
    bool operator==(const Response&) const = default;
  };
};

struct ListParameters {
  static constexpr std::string_view kType = "rcl_interfaces/srv/ListParameters";

  struct Request {
    std::vector<std::string> prefixes;
    std::uint64_t depth = 0;

    static constexpr std::string_view kType = "rcl_interfaces/srv/ListParameters_Request";
    static constexpr std::tuple kFields{Field{&Request::prefixes, "prefixes"},
                                        Field{&Request::depth, "depth"}};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    ListParametersResult result;

    static constexpr std::string_view kType = "rcl_interfaces/srv/ListParameters_Response";
    static constexpr std::tuple kFields{Field{&Response::result, "result"}};
    bool operator==(const Response&) const = default;
  };
};

struct DescribeParameters {
  static constexpr std::string_view kType = "rcl_interfaces/srv/DescribeParameters";

  struct Request {
    std::vector<std::string> names;

    static constexpr std::string_view kType = "rcl_interfaces/srv/DescribeParameters_Request";
    static constexpr std::tuple kFields{Field{&Request::names, "names"}};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    std::vector<ParameterDescriptor> descriptors;

    static constexpr std::string_view kType = "rcl_interfaces/srv/DescribeParameters_Response";
    static constexpr std::tuple kFields{Field{&Response::descriptors, "descriptors"}};
    bool operator==(const Response&) const = default;
  };
};

}  // namespace astro::ros2::msg
