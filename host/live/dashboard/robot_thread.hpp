#pragma once

#include <atomic>
#include <functional>
#include <thread>

#include "host/base/error.hpp"
#include "host/live/dashboard/delivery.hpp"
#include "host/live/dashboard/question_queue.hpp"
#include "host/page/robot/robot_calls.hpp"

namespace astro::dashboard {

/// The calls on the robot in a thread of their own: the robot is served whatever a network or a computation does.
class RobotThread {
 public:
  /// `recordings`: its `keep` is called in this thread.
  RobotThread(page::RobotPorts ports, page::RecordingPlace recordings, Delivery delivery,
              std::function<void(const Remark&)> notice);
  /// A robot that a page drives is at rest and disarmed then, and recordings have ended.
  ~RobotThread();
  RobotThread(const RobotThread&) = delete;
  RobotThread& operator=(const RobotThread&) = delete;

  /// May be called from any thread.
  void ask(Question question);

 private:
  void run();
  void carry_out(page::RobotCalls& calls, const Question& question);

  page::RobotPorts ports_;
  page::RecordingPlace recordings_;
  Delivery delivery_;
  std::function<void(const Remark&)> notice_;
  QuestionQueue questions_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace astro::dashboard
