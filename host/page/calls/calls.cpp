#include "host/page/calls/calls.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/page/calls/attempt.hpp"
#include "host/page/calls/calibrate.hpp"
#include "host/page/calls/inspect.hpp"
#include "host/page/calls/remedies.hpp"
#include "host/page/calls/try_out.hpp"

namespace astro::page {
namespace {

using nlohmann::json;

struct Call {
  std::string_view name;
  json (*answer)(const json& question, const std::filesystem::path& folder, const Emit& emit);
};

constexpr std::array kCalls{Call{"calibrate", calibrate}, Call{"inspect", inspect}, Call{"try_out", try_out}};

/// Takes the folder away from each text that names a file in it: whoever asks knows files by their names.
void make_relative(json& value, const std::string& folder) {
  if (value.is_string()) {
    auto& text = value.get_ref<std::string&>();
    for (std::size_t at; (at = text.find(folder)) != text.npos;) text.erase(at, folder.size());
  } else if (value.is_structured()) {
    for (json& each : value) make_relative(each, folder);
  }
}

json answered(const std::string& call, const json& question, const std::filesystem::path& folder,
              const Emit& emit) {
  for (const Call& each : kCalls) {
    if (each.name != call) continue;
    if (!question.is_object()) return refusal("the question is no object");
    return attempt([&] { return each.answer(question, folder, emit); }, remedies);
  }
  return refusal("there is no call '" + call + "'", {call});
}

}  // namespace

json answer(const std::string& call, const json& question, const std::filesystem::path& folder,
            const Emit& emit) {
  if (folder.empty()) return answered(call, question, folder, emit);
  const std::string prefix = (folder / "").string();
  json told = answered(call, question, folder, [&](json event) {
    make_relative(event, prefix);
    emit(event);
  });
  make_relative(told, prefix);
  return told;
}

std::string json_text(const json& answer) {
  return answer.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace astro::page
