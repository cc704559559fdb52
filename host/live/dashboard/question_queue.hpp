#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace astro::dashboard {

/// Counts from 1 in the order in which pages came.
using Page = int;

/// A call of a page, or the end of the page.
struct Question {
  using Clock = std::chrono::steady_clock;

  Page page = 0;
  std::int64_t id = 0;  // the page's own number for it
  std::string call;     // kPageGone: the page has gone
  nlohmann::json question = nlohmann::json::object();
  Clock::time_point came = Clock::now();
};
inline constexpr std::string_view kPageGone = "";

/// What waits for the robot. Any thread pushes, one takes.
///
/// Order   what stops the robot overtakes all else, and what was asked before to move the robot is withdrawn: a robot does not
///         move after a stop because of what was said before it. The end of a page stops the robot, too, and withdraws all that
///         the page has asked.
/// Bounds  kMost questions of each page, without those that stop.
class QuestionQueue {
 public:
  static constexpr std::size_t kMost = 64;

  /// The questions that are not carried out because of this one: those that a stop withdraws, or this one if too many wait.
  [[nodiscard]] std::vector<Question> push(Question question);
  std::optional<Question> pop();
  /// Returns when something waits, or at the latest after `timeout`.
  void wait(std::chrono::microseconds timeout);

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Question> urgent_, others_;
};

}  // namespace astro::dashboard
