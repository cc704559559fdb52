#include "host/truth/trackers/vrpn_reader.hpp"

#include <string>

#include "host/base/error.hpp"

namespace astro::truth::vrpn {

void StreamReader::drop_taken() {
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(taken_));
  before_ += taken_;
  taken_ = 0;
}

/// Refuses another program's first bytes at once, not only when there are as many as in a cookie.
bool StreamReader::take_cookie() {
  const std::size_t came = std::min(pending_.size(), kCookieBytes);
  const Bytes expected = cookie();
  constexpr std::size_t kSame = 14;  // "vrpn: ver. 07."
  for (std::size_t i = 0; i < std::min(came, kSame); ++i)
    if (pending_[i] != expected[i])
      throw Error("the first bytes are not those of a VRPN server of version 07", VrpnProblem::other_program);
  if (came < kCookieBytes) return false;
  taken_ = kCookieBytes;
  return greeted_ = true;
}

std::optional<Message> StreamReader::next() {
  if (!greeted_ && !take_cookie()) return std::nullopt;
  const ByteView left = ByteView(pending_).subspan(taken_);
  const bool whole_header = left.size() >= kHeaderBytes;
  if (whole_header) {
    const std::uint32_t length = length_in(left);
    if (const std::string fault = fault_of_length(length); !fault.empty())
      throw Error("byte " + std::to_string(before_ + taken_) + " begins " + fault,
                  VrpnProblem::impossible_length, {std::to_string(length), std::to_string(before_ + taken_)});
    if (left.size() >= padded(length)) {
      taken_ += padded(length);
      return message_in(left);
    }
  }
  drop_taken();
  return std::nullopt;
}

std::vector<Message> messages_in(ByteView datagram) {
  std::vector<Message> messages;
  for (ByteView left = datagram; !left.empty();) {
    if (left.size() < kHeaderBytes)
      throw Error("the last " + std::to_string(left.size()) + " bytes of a datagram are no message",
                  VrpnProblem::no_header, {std::to_string(left.size())});
    const std::uint32_t length = length_in(left);
    if (const std::string fault = fault_of_length(length); !fault.empty())
      throw Error("a datagram with " + fault, VrpnProblem::impossible_length, {std::to_string(length)});
    if (left.size() < length)
      throw Error("a message of " + std::to_string(length) + " bytes in a datagram that ends after " +
                      std::to_string(left.size()),
                  VrpnProblem::cut_off, {std::to_string(length), std::to_string(left.size())});
    messages.push_back(message_in(left));
    left = left.subspan(std::min(padded(length), left.size()));
  }
  return messages;
}

}  // namespace astro::truth::vrpn
