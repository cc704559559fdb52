#include "host/simulation/server/pace.hpp"

#include <algorithm>

namespace astro::simulation {
namespace {

using namespace std::chrono_literals;

constexpr Pace::Duration kRestartAfter = 2s;
constexpr Pace::Duration kBurst = 20ms;  // a tenth of the command time-out
constexpr int kFastest = 2;              // virtual over real time while it catches up

}  // namespace

void Pace::restart(Time now) {
  due_ = asked_ = next_ = now;
  credit_ = kStep;
}

bool Pace::due(Time now) {
  if (now - due_ > kRestartAfter) restart(now);
  credit_ = std::min<Duration>(credit_ + kFastest * std::max<Duration>(now - asked_, 0ms), kBurst);
  asked_ = now;
  if (now < due_) {
    next_ = due_;
    return false;
  }
  next_ = now + std::max<Duration>(kStep - credit_, 0ms) / kFastest;
  return credit_ >= kStep;
}

void Pace::stepped() {
  due_ += kStep;
  credit_ = std::max<Duration>(credit_ - kStep, 0ms);
  next_ = due_;
}

}  // namespace astro::simulation
