#include "host/live/dashboard/call_thread.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "host/base/blocked_signals.hpp"
#include "host/page/calls/attempt.hpp"
#include "host/page/calls/calls.hpp"
#include "host/page/robot/robot_calls.hpp"

namespace astro::dashboard {
namespace {

/// Ends a call from within its events; no std::exception, which would become an answer.
struct Ended {};

constexpr std::chrono::milliseconds kLook{50};

}  // namespace

CallThread::CallThread(page::RobotPorts ports, std::filesystem::path folder, Delivery delivery)
    : ports_(std::move(ports)), folder_(std::move(folder)), delivery_(std::move(delivery)) {
  const BlockedSignals blocked;  // signals are for the program's own thread
  thread_ = std::thread([this] { run(); });
}

CallThread::~CallThread() {
  ending_ = true;
  thread_.join();
}

bool CallThread::takes(std::string_view call) {
  return call == "robot/ports" || (call != kPageGone && !page::RobotCalls::is_named(call));
}

void CallThread::ask(Question question) {
  for (const Question& each : questions_.push(std::move(question)))
    delivery_.answer(each, page::refusal("too many questions of this page wait: wait for their answers"));
}

void CallThread::run() {
  while (!ending_) {
    while (const auto question = questions_.pop()) {
      if (ending_) return;
      carry_out(*question);
    }
    questions_.wait(kLook);
  }
}

void CallThread::carry_out(const Question& question) try {
  if (question.call == "robot/ports")
    return delivery_.answer(question, page::RobotCalls::ports_answer(ports_));
  const auto told = [&](const nlohmann::json& event) {
    if (ending_) throw Ended();
    delivery_.event(question.page, question.id, event);
  };
  delivery_.answer(question, page::answer(question.call, question.question, folder_, told));
} catch (const Ended&) {
} catch (const std::exception& error) {  // no memory, for one
  delivery_.answer(question, page::refusal(error.what()));
}

}  // namespace astro::dashboard
