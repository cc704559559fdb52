#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "host/page/calls/attempt.hpp"
#include "host/page/calls/calls.hpp"
#include "host/page/robot/real_time.hpp"
#include "host/page/robot/robot_calls.hpp"
#include "host/page/wasm/page_port.hpp"
#include "host/robot/client/restore.hpp"

/// The module's whole surface: answer(call, question, emit, waited_ms), where call, question and what is answered are texts of JSON, and
/// emit is a function that gets one; the question was asked waited_ms ago. Files are those of Emscripten's file system in memory
/// below kFolder. Events of the robot come with the call during which they happen, so the page asks robot/step {"now_s": seconds of its
/// clock} about every 20 ms while a robot is open. stops(call) and moves(call) say what RobotCalls does of a call. A page that gives the module an object `serial` (page_port.hpp) has ports.
namespace {

using astro::microseconds;
using nlohmann::json;

constexpr const char* kFolder = "/files-of-the-page";
constexpr astro::page::Page kThisPage = 1;
/// How long a step lets a robot at a port work, of the 20 ms between two of them.
constexpr microseconds kStep = std::chrono::milliseconds(15);

astro::page::RobotPorts ports_of_the_page() {
  astro::page::RobotPorts ports;
  ports.open = [](const std::string& name) { return std::make_unique<astro::page::PagePort>(name); };
  return ports;
}

microseconds in_microseconds(double time_s) { return microseconds(std::llround(1e6 * time_s)); }

class RobotOfThePage {
 public:
  /// Also from within a measurement, which takes the questions that come meanwhile.
  json answer(const std::string& call, const json& question, const astro::page::Emit& emit,
              microseconds waited) {
    const astro::robot::Restore emitting(emit_, &emit);
    return call == "robot/step" ? step(question) : calls_.answer(kThisPage, call, question, waited);
  }

 private:
  json step(const json& question) {
    if (!question.is_object() || !question.contains("now_s") || !question["now_s"].is_number())
      return astro::page::refusal("now_s is no number");
    const auto now_s = question["now_s"].get<double>();
    const auto robot = calls_.simulated_now();
    if (!robot) pace_ = {};
    calls_.step(robot ? pace_.due(in_microseconds(now_s), *robot) : kStep);
    return {{"result", json::object()}};
  }

  const astro::page::Emit* emit_ = nullptr;  // of the call under way
  astro::page::RobotCalls calls_{ports_of_the_page(),
                                 {.folder = kFolder},
                                 [this](astro::page::Page, const json& event) {
                                   if (emit_ != nullptr) (*emit_)(event);
                                 },
                                 [] {
                                   astro::page::PagePort::take_questions();
                                   return false;
                                 }};
  astro::page::RealTime pace_;
};

std::string answer(const std::string& call, const std::string& question, emscripten::val emit,
                   double waited_ms) {
  static RobotOfThePage robot;
  const auto parsed = json::parse(question, nullptr, false);
  const auto told = [&emit](const json& event) { emit(astro::page::json_text(event)); };
  return astro::page::json_text(astro::page::RobotCalls::is_named(call)
                                    ? robot.answer(call, parsed, told, in_microseconds(1e-3 * waited_ms))
                                    : astro::page::answer(call, parsed, kFolder, told));
}

}  // namespace

bool stops(const std::string& call) { return astro::page::RobotCalls::stops(call); }
bool moves(const std::string& call) { return astro::page::RobotCalls::moves(call); }

EMSCRIPTEN_BINDINGS(astrolabe) {
  emscripten::function("answer", &answer);
  emscripten::function("stops", &stops);
  emscripten::function("moves", &moves);
}
