#pragma once

#include <functional>
#include <string>

#include "host/live/dashboard/question_queue.hpp"
#include "host/live/dashboard/token.hpp"
#include "host/live/web/site.hpp"

namespace astro::dashboard {

/// One page that is open, at the other end of its WebSocket. Its first message says the token; then it asks:
///
///   {"token": "..."}                              -> {"id": 0, "answer": {"result": {"page": its number}}}
///   {"id": 1, "call": "...", "question": {...}}   -> {"id": 1, "event": ...} ..., {"id": 1, "answer": ...}
class PageClient : public web::Client {
 public:
  struct Hooks {
    std::function<std::string()> why_full;  // why there is no room for another page; "" if there is
    std::function<void(PageClient&)> joined;
    std::function<void(Question)> asked;
    std::function<void(PageClient&)> left;  // if it had joined
  };

  PageClient(Page page, const Token& token, Hooks hooks)
      : page_(page), token_(token), hooks_(std::move(hooks)) {}
  ~PageClient() override;

  Page page() const { return page_; }
  void send(std::string text) { queue_.push_control({true, std::move(text), nullptr, 0}); }
  /// What may be dropped if the page does not read fast enough.
  void send_data(web::SharedSample text) { queue_.push_data({true, "", std::move(text), 0}); }

  void receive(bool is_text, ByteView message) override;
  web::FrameQueue& queue() override { return queue_; }
  bool watches() const override { return admitted_; }
  bool is_admitted() const override { return admitted_; }
  std::string why_refused() const override { return why_refused_; }

 private:
  void admit(const nlohmann::json& message);
  void ask(const nlohmann::json& message);

  Page page_;
  const Token& token_;
  Hooks hooks_;
  web::FrameQueue queue_;
  bool admitted_ = false;
  std::string why_refused_;
};

}  // namespace astro::dashboard
