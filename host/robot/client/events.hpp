#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace astro::robot {

/// Ends the registration when it is destroyed.
using Subscription = std::shared_ptr<const void>;

/// Callbacks for events of type M. A callback may subscribe and unsubscribe, and may throw: the exception
/// leaves the call that read the event, and nothing read so far is lost. It must not call the Client.
template <class M>
class Listeners {
 public:
  using Callback = std::function<void(const M&)>;

  [[nodiscard]] Subscription add(Callback callback) {
    auto shared = std::make_shared<const Callback>(std::move(callback));
    callbacks_.push_back(shared);
    return shared;
  }

  void call(const M& message) {
    std::erase_if(callbacks_, [](const auto& weak) { return weak.expired(); });
    const auto now = callbacks_;
    for (const auto& weak : now) {
      if (const auto callback = weak.lock()) (*callback)(message);
    }
  }

 private:
  std::vector<std::weak_ptr<const Callback>> callbacks_;
};

}  // namespace astro::robot
