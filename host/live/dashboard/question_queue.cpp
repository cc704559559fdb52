#include "host/live/dashboard/question_queue.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "host/page/robot/robot_calls.hpp"

namespace astro::dashboard {
namespace {

bool stops(std::string_view call) { return call == kPageGone || page::RobotCalls::stops(call); }

}  // namespace

std::vector<Question> QuestionQueue::push(Question question) {
  const std::lock_guard lock(mutex_);
  std::vector<Question> refused;
  if (stops(question.call)) {
    // A page that has gone stops the robot only if it drives, so others' requests stay. Of its own nothing may be done any more:
    // nobody would end what a page watches or records that is not there.
    const bool gone = question.call == kPageGone;
    const auto stays = std::stable_partition(others_.begin(), others_.end(), [&](const Question& each) {
      return gone ? each.page != question.page : !page::RobotCalls::moves(each.call);
    });
    std::move(stays, others_.end(), std::back_inserter(refused));
    others_.erase(stays, others_.end());
    urgent_.push_back(std::move(question));
  } else if (std::ranges::count(others_, question.page, &Question::page) >=
             static_cast<std::ptrdiff_t>(kMost)) {
    refused.push_back(std::move(question));
  } else {
    others_.push_back(std::move(question));
  }
  came_.notify_one();
  return refused;
}

std::optional<Question> QuestionQueue::pop() {
  const std::lock_guard lock(mutex_);
  for (std::deque<Question>* each : {&urgent_, &others_}) {
    if (each->empty()) continue;
    Question first = std::move(each->front());
    each->pop_front();
    return first;
  }
  return std::nullopt;
}

void QuestionQueue::wait(std::chrono::microseconds timeout) {
  std::unique_lock lock(mutex_);
  came_.wait_for(lock, timeout, [this] { return !urgent_.empty() || !others_.empty(); });
}

}  // namespace astro::dashboard
