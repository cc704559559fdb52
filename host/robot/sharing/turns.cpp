#include "host/robot/sharing/turns.hpp"

#include <algorithm>

namespace astro::robot {

void Turns::wait(SessionId id) {
  if (std::find(waiting_.begin(), waiting_.end(), id) == waiting_.end()) waiting_.push_back(id);
}

void Turns::end(SessionId id) {
  if (under_way_ == id) under_way_.reset();
  std::erase(waiting_, id);
}

void Turns::clear() {
  under_way_.reset();
  waiting_.clear();
}

std::optional<SessionId> Turns::next(microseconds now) {
  if (under_way_ && now >= deadline_) under_way_.reset();
  if (under_way_ || waiting_.empty()) return std::nullopt;
  const SessionId id = waiting_.front();
  waiting_.pop_front();
  return id;
}

void Turns::begin(SessionId id, microseconds deadline) {
  under_way_ = id;
  deadline_ = deadline;
}

std::optional<microseconds> Turns::deadline() const {
  if (!under_way_ || waiting_.empty()) return std::nullopt;
  return deadline_;
}

}  // namespace astro::robot
