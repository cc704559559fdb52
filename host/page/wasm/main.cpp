#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <nlohmann/json.hpp>
#include <string>

#include "host/page/calls/calls.hpp"

/// The module's whole surface: answer(call, question, emit), all three texts of JSON but the last, a function that gets one.
/// Files are those of Emscripten's file system in memory below kFolder.
namespace {

constexpr const char* kFolder = "/files-of-the-page";

std::string answer(const std::string& call, const std::string& question, emscripten::val emit) {
  const auto parsed = nlohmann::json::parse(question, nullptr, false);
  const auto told = [&emit](const nlohmann::json& event) { emit(astro::page::json_text(event)); };
  return astro::page::json_text(astro::page::answer(call, parsed, kFolder, told));
}

}  // namespace

EMSCRIPTEN_BINDINGS(astrolabe) { emscripten::function("answer", &answer); }
