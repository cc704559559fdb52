#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <span>
#include <string>

#include "host/live/foxglove/catalogue.hpp"
#include "host/live/foxglove/requests.hpp"
#include "host/live/foxglove/session.hpp"

namespace astro::foxglove {

/// One robot, several viewers: what the robot offers, and a Session for each client. Does no I/O and has no clock; the server
/// moves what waits in the sessions' queues.
///
/// Threads  one, the server's.
class Hub {
 public:
  /// `name` and `session_id`: as in Catalogue. `takes_messages`: whether clients may publish at all.
  Hub(std::string name, std::string session_id, bool takes_messages, RequestSink sink);

  /// Adds a channel (inlet, service). Its id is its number among those of its kind, from 1. Clients that are there are told.
  void add(Channel channel);
  void add(Inlet inlet);
  void add(Service service);
  /// To be called before the first client joins.
  void has_parameters() { catalogue_.has_parameters = true; }

  /// Adds a client, which gets the list of all that is there. The session's address does not change until leave().
  Session& join();
  void leave(ClientId id);
  /// `make_room`: see Watchers.
  void on_crowd(std::function<void()> make_room) { watchers_.make_room = std::move(make_room); }

  void publish(std::uint32_t channel, SharedSample sample);
  /// Answers of the robot; those to clients that have left are dropped.
  void answer_text(ClientId client, std::string text);
  void answer_binary(ClientId client, std::string bytes);
  /// Sends a control message that answers nothing.
  void tell(ClientId client, std::string text);
  void parameters_changed(std::span<const ros2::msg::Parameter> parameters);
  bool parameters_are_watched() const;

  /// Tells the clients what has changed in the connection graph, and what was dropped. Meant to be called a few times a second, so
  /// that neither becomes a flood.
  void report();

 private:
  Session* session(ClientId id);
  ConnectionGraph graph() const;

  Catalogue catalogue_;
  RequestSink sink_;
  Watchers watchers_;
  std::list<Session> sessions_;
  ClientId last_client_ = 0;
};

}  // namespace astro::foxglove
