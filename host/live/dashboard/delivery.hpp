#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "host/live/dashboard/question_queue.hpp"

namespace astro::dashboard {

/// How answers and events reach their pages; any thread may call it.
struct Delivery {
  /// {"id", "answer"}
  std::function<void(const Question&, const nlohmann::json& answer)> answer;
  /// {"id", "event"}; of something that no page has asked, id is 0 and page 0 all of them.
  std::function<void(Page page, std::int64_t id, const nlohmann::json& event)> event;
};

}  // namespace astro::dashboard
