#include "host/live/dashboard/page_client.hpp"

#include <exception>
#include <nlohmann/json.hpp>

#include "host/base/text/json_weight.hpp"
#include "host/page/calls/attempt.hpp"
#include "host/page/calls/calls.hpp"

namespace astro::dashboard {

using nlohmann::json;

PageClient::~PageClient() {
  if (!admitted_) return;
  try {
    hooks_.left(*this);
  } catch (const std::exception&) {  // no memory; the robot's time-outs hold all the same
  }
}

void PageClient::receive(bool is_text, ByteView message) {
  const std::string_view text = as_text(message);
  const json parsed = is_text && json_fits_memory(text) ? json::parse(text, nullptr, false) : json();
  admitted_ ? ask(parsed) : admit(parsed);
}

void PageClient::admit(const json& message) {
  const auto found = message.is_object() ? message.find("token") : message.end();
  if (!message.is_object() || found == message.end() || !found->is_string() ||
      !token_.is(found->get_ref<const std::string&>())) {
    why_refused_ = "this is not the token of this session: open the link that was printed at its start";
    return;
  }
  why_refused_ = hooks_.why_full();
  if (!why_refused_.empty()) return;
  admitted_ = true;
  send(json{{"id", 0}, {"answer", {{"result", {{"page", page_}}}}}}.dump());
  hooks_.joined(*this);
}

void PageClient::ask(const json& message) {
  Question question{page_, 0, "", json::object()};
  if (message.is_object()) {
    if (const auto id = message.find("id"); id != message.end() && id->is_number_integer())
      question.id = id->get<std::int64_t>();
    if (const auto call = message.find("call"); call != message.end() && call->is_string())
      question.call = call->get<std::string>();
    if (const auto asked = message.find("question"); asked != message.end()) question.question = *asked;
  }
  if (question.call.empty())  // which would be the end of the page
    return send(page::json_text({{"id", question.id}, {"answer", page::refusal("the message is no call")}}));
  hooks_.asked(std::move(question));
}

}  // namespace astro::dashboard
