#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/truth/trackers/vrpn_message.hpp"

namespace astro::truth::vrpn {

/// Why bytes are not those of VRPN.
enum class VrpnProblem {
  other_program,
  impossible_length,  // values: the length, and in a stream the byte at which its message begins
  no_header,          // value: the bytes that are left
  cut_off             // values: the length, and the bytes that are left
};

/// The messages of one TCP connection, from bytes that arrive in any pieces.
///
/// Errors  next() throws astro::Error, a clause that says at which byte of the connection the other side
///         turned out not to speak VRPN: another cookie, or a length that no message has. It cannot go on
///         after that, because nothing marks where the next message begins.
/// Bounds  holds what was pushed and not taken by next(), and one message that is not complete.
class StreamReader {
 public:
  void push(ByteView bytes) { astro::append(pending_, bytes); }

  /// The next whole message, valid until the next call of either function; nothing until more bytes come.
  std::optional<Message> next();

  /// The other side's cookie has come: it is a VRPN server.
  bool greeted() const { return greeted_; }

 private:
  void drop_taken();
  bool take_cookie();

  Bytes pending_;
  std::size_t taken_ = 0;   // bytes of pending_ that next() has returned
  std::size_t before_ = 0;  // bytes of the connection before pending_
  bool greeted_ = false;
};

/// The messages of one UDP datagram, which are valid as long as its bytes. Throws astro::Error, a clause that
/// says what is wrong, if not all of it is messages.
std::vector<Message> messages_in(ByteView datagram);

}  // namespace astro::truth::vrpn
