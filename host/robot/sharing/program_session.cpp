#include "host/robot/sharing/program_session.hpp"

#include <algorithm>
#include <utility>

#include "common/protocol/messages.hpp"
#include "host/robot/sharing/request_rules.hpp"

namespace astro::robot {

using protocol::Header;

Exchange& ProgramSession::ping(const Header& header, ByteView body) {
  const auto repeated =
      std::find_if(pings_.begin(), pings_.end(), [&](const Exchange& ping) { return ping.header == header; });
  if (repeated != pings_.end()) return *repeated;
  Exchange& oldest = pings_[next_ping_];
  next_ping_ = (next_ping_ + 1) % pings_.size();
  return oldest = Exchange(header, body);
}

std::optional<Header> ProgramSession::take_pong(const Header& answer, microseconds now) {
  for (Exchange& ping : pings_)
    if (ping.is_answered_by(answer, now)) return std::exchange(ping, {}).header;
  return std::nullopt;
}

bool ProgramSession::has_answered(const Header& request) const {
  return !answer_.empty() && answered_ == request;
}

void ProgramSession::remember_answer(const Header& request, const Bytes& frame) {
  if (request.message_id == protocol::Ping::kId || request.message_id == protocol::Hello::kId) return;
  if (has_under_way(request)) end();
  if (request_rules::halts(request.message_id)) return;
  answered_ = request;
  answer_ = frame;
}

void ProgramSession::forget() {
  end();
  pings_ = {};
  answer_.clear();
}

}  // namespace astro::robot
