#pragma once

#include <cstdint>
#include <functional>
#include <variant>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/live/foxglove/client_messages.hpp"

/// Requests of clients that the robot's thread has to carry out. The server itself answers all others.
namespace astro::foxglove {

using ClientId = std::uint32_t;

struct MessageArrived {
  std::uint32_t inlet = 0;
  Bytes message;
};

struct CallArrived {
  ClientId client = 0;
  std::uint32_t service = 0, call = 0;
  Bytes request;
};

struct ParametersAsked {
  ClientId client = 0;
  GetParameters what;
};

struct ParametersGiven {
  ClientId client = 0;
  SetParameters what;
};

/// For the person who started the server.
struct NoticeArrived {
  Remark remark;
};

using Request = std::variant<MessageArrived, CallArrived, ParametersAsked, ParametersGiven, NoticeArrived>;
using RequestSink = std::function<void(Request)>;

}  // namespace astro::foxglove
