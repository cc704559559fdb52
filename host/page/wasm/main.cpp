#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "host/page/calls/attempt.hpp"
#include "host/page/calls/calls.hpp"
#include "host/page/robot/real_time.hpp"
#include "host/page/robot/robot_calls.hpp"

/// The module's whole surface: answer(call, question, emit), all three texts of JSON but the last, a function that gets one.
/// Files are those of Emscripten's file system in memory below kFolder. Events of the robot come with the call during which they
/// happen, so the page asks robot/step {"now_s": seconds of its clock} about every 20 ms while a robot is open.
namespace {

using astro::microseconds;
using nlohmann::json;

constexpr const char* kFolder = "/files-of-the-page";
constexpr astro::page::Page kThisPage = 1;

class RobotOfThePage {
 public:
  json answer(const std::string& call, const json& question, const astro::page::Emit& emit) {
    emit_ = &emit;
    const json told = call == "robot/step" ? step(question) : calls_.answer(kThisPage, call, question);
    emit_ = nullptr;
    return told;
  }

 private:
  json step(const json& question) {
    if (!question.is_object() || !question.contains("now_s") || !question["now_s"].is_number())
      return astro::page::refusal("now_s is no number");
    const auto now_s = question["now_s"].get<double>();
    const auto robot = calls_.simulated_now();
    if (!robot) pace_ = {};
    calls_.step(robot ? pace_.due(microseconds(std::llround(1e6 * now_s)), *robot) : microseconds::zero());
    return {{"result", json::object()}};
  }

  const astro::page::Emit* emit_ = nullptr;  // of the call under way
  astro::page::RobotCalls calls_{{}, {.folder = kFolder}, [this](astro::page::Page, const json& event) {
                                   if (emit_ != nullptr) (*emit_)(event);
                                 }};
  astro::page::RealTime pace_;
};

std::string answer(const std::string& call, const std::string& question, emscripten::val emit) {
  static RobotOfThePage robot;
  const auto parsed = json::parse(question, nullptr, false);
  const auto told = [&emit](const json& event) { emit(astro::page::json_text(event)); };
  return astro::page::json_text(astro::page::RobotCalls::is_named(call)
                                    ? robot.answer(call, parsed, told)
                                    : astro::page::answer(call, parsed, kFolder, told));
}

}  // namespace

EMSCRIPTEN_BINDINGS(astrolabe) { emscripten::function("answer", &answer); }
