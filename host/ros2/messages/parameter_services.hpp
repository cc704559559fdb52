#pragma once

#include "host/ros2/messages/parameters.hpp"

/// The services by which a node shows and changes its parameters.
namespace astro::ros2::msg {

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
