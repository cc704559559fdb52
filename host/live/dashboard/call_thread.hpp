#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

#include "host/live/dashboard/delivery.hpp"
#include "host/live/dashboard/question_queue.hpp"
#include "host/page/robot/opened_robot.hpp"

namespace astro::dashboard {

/// The calls that compute for seconds, one after the other, in a thread of their own (host/page/calls), and the list of ports.
class CallThread {
 public:
  /// `folder`: the files of the pages.
  CallThread(page::RobotPorts ports, std::filesystem::path folder, Delivery delivery);
  /// A call that is under way ends at its next event.
  ~CallThread();
  CallThread(const CallThread&) = delete;
  CallThread& operator=(const CallThread&) = delete;

  /// Whether the call is one of these. All others concern the robot.
  static bool takes(std::string_view call);
  /// May be called from any thread.
  void ask(Question question);

 private:
  void run();
  void carry_out(const Question& question);

  page::RobotPorts ports_;
  std::filesystem::path folder_;
  Delivery delivery_;
  QuestionQueue questions_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace astro::dashboard
