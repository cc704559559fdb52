#pragma once

#include "host/ros2/cdr/message.hpp"

/// A service is a struct with the messages Request and Response, and the name of its type.
namespace astro::ros2::msg {

struct Trigger {
  static constexpr std::string_view kType = "std_srvs/srv/Trigger";

  struct Request {
    static constexpr std::string_view kType = "std_srvs/srv/Trigger_Request";
    static constexpr std::tuple<> kFields{};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    bool success = false;
    std::string message;

    static constexpr std::string_view kType = "std_srvs/srv/Trigger_Response";
    static constexpr std::tuple kFields{Field{&Response::success, "success"},
                                        Field{&Response::message, "message"}};
    bool operator==(const Response&) const = default;
  };
};

struct SetBool {
  static constexpr std::string_view kType = "std_srvs/srv/SetBool";

  struct Request {
    bool data = false;

    static constexpr std::string_view kType = "std_srvs/srv/SetBool_Request";
    static constexpr std::tuple kFields{Field{&Request::data, "data"}};
    bool operator==(const Request&) const = default;
  };

  struct Response {
    bool success = false;
    std::string message;

    static constexpr std::string_view kType = "std_srvs/srv/SetBool_Response";
    static constexpr std::tuple kFields{Field{&Response::success, "success"},
                                        Field{&Response::message, "message"}};
    bool operator==(const Response&) const = default;
  };
};

}  // namespace astro::ros2::msg
