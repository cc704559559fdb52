#include "host/live/dashboard/robot_thread.hpp"

#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "host/base/blocked_signals.hpp"
#include "host/page/calls/attempt.hpp"
#include "host/page/robot/real_time.hpp"

namespace astro::dashboard {
namespace {

using std::chrono::milliseconds;

// Between looks at the questions: an armed robot's stop must not wait for longer than a control tick or two.
constexpr milliseconds kArmed{2}, kIdle{5}, kNothingOpen{100};

}  // namespace

RobotThread::RobotThread(page::RobotPorts ports, page::RecordingPlace recordings, Delivery delivery,
                         std::function<void(const Remark&)> notice)
    : ports_(std::move(ports)),
      recordings_(std::move(recordings)),
      delivery_(std::move(delivery)),
      notice_(std::move(notice)) {
  const BlockedSignals blocked;  // signals are for the program's own thread
  thread_ = std::thread([this] { run(); });
}

RobotThread::~RobotThread() {
  ending_ = true;
  thread_.join();
}

void RobotThread::ask(Question question) {
  const bool stop = question.call == kPageGone;
  for (const Question& each : questions_.push(std::move(question))) {
    if (each.call == kPageGone || stop) continue;  // nobody is there to read it
    delivery_.answer(each, page::refusal("it was not carried out: the robot was stopped, or too much waits"));
  }
}

void RobotThread::run() {
  const auto tell = [this](page::Page page, const nlohmann::json& event) { delivery_.event(page, 0, event); };
  page::RobotCalls calls(ports_, recordings_, tell, [&] {
    if (const auto question = questions_.pop()) carry_out(calls, *question);
    return ending_.load();
  });
  page::RealTime pace;
  while (!ending_) try {
      // One at a time: however much pages ask, the robot is served between two questions.
      const auto question = questions_.pop();
      if (question) carry_out(calls, *question);
      const auto wall =
          std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
      if (const auto robot = calls.simulated_now()) {
        calls.step(pace.due(wall, *robot));
        if (!question) questions_.wait(kIdle);
      } else {
        pace = {};
        calls.step(question ? microseconds::zero() : calls.armed() ? kArmed : kIdle);
        if (!question && !calls.waits_for_robot()) questions_.wait(calls.is_open() ? kIdle : kNothingOpen);
      }
    } catch (const std::exception& error) {  // no memory, for one
      notice_({std::string("a page's question could not be carried out: ") + error.what()});
    }
}

void RobotThread::carry_out(page::RobotCalls& calls, const Question& question) {
  if (question.call == kPageGone) return calls.leave(question.page);
  const auto waited = std::chrono::duration_cast<microseconds>(Question::Clock::now() - question.came);
  delivery_.answer(question, calls.answer(question.page, question.call, question.question, waited));
}

}  // namespace astro::dashboard
