#include "host/live/dashboard/dashboard.hpp"

#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "host/live/dashboard/call_thread.hpp"
#include "host/live/dashboard/dashboard_site.hpp"
#include "host/live/dashboard/robot_thread.hpp"
#include "host/page/calls/calls.hpp"

namespace astro::dashboard {
namespace {

using nlohmann::json;

std::filesystem::path required_page(const std::filesystem::path& folder) {
  std::error_code gone;
  if (!std::filesystem::is_regular_file(folder / "index.html", gone))
    throw Error("there is no page in '" + folder.string() + "'", DashboardProblem::no_page,
                {folder.string()});
  return folder;
}

/// Telemetry is of the moment; a page that does not read misses some of it.
bool may_drop(const json& event) {
  const std::string& kind = event.at("event").get_ref<const std::string&>();
  return kind == "samples" || kind == "pose";
}

}  // namespace

class Dashboard::Impl {
 public:
  explicit Impl(const Settings& settings)
      : notice_(settings.notice),
        kept_in_(settings.recordings),
        site_(required_page(settings.page), settings.page_timeout, token_, files_,
              {[this](Question question) { ask(std::move(question)); }, settings.notice}),
        server_(std::in_place, settings.address, site_),
        calls_(settings.ports, files_.folder(), delivery()),
        robot_(settings.ports,
               {.folder = files_.folder(), .keep = [this](const std::filesystem::path& file) { keep(file); }},
               delivery(), settings.notice) {
    if (!settings.port.empty()) robot_.ask({0, 0, "robot/open", {{"port", settings.port}}});
    server_->start();
  }

  /// The server's thread asks the other two, and they tell it what they have found: first nothing is told any more, then nothing
  /// asked.
  ~Impl() {
    {
      const std::lock_guard lock(sending_);
      closed_ = true;
    }
    server_.reset();
  }

  std::uint16_t port() const { return server_->port(); }
  const Token& token() const { return token_; }

  std::filesystem::path file_leading_to(const std::string& link) const {
    const std::filesystem::path file = files_.folder() / ".link.html";
    std::ofstream(file) << "<!doctype html><meta http-equiv=\"refresh\" content=\"0; url=" << link << "\">\n";
    return file;
  }

 private:
  void ask(Question question) {
    CallThread::takes(question.call) ? calls_.ask(std::move(question)) : robot_.ask(std::move(question));
  }

  Delivery delivery() {
    return {[this](const Question& question, const json& answer) {
              if (question.page == 0) return tell_starter(answer);
              send(question.page, {{"id", question.id}, {"answer", answer}}, false);
            },
            [this](Page page, std::int64_t id, const json& event) {
              send(page, {{"id", id}, {"event", event}}, may_drop(event));
            }};
  }

  /// The robot that was named at the start may not be there.
  void tell_starter(const json& answer) {
    if (answer.contains("error")) notice_({answer["error"]["sentence"].get<std::string>()});
  }

  void send(Page page, const json& message, bool may_drop) {
    auto task = [this, page, may_drop, text = page::json_text(message)] { site_.send(page, text, may_drop); };
    const std::lock_guard lock(sending_);
    if (closed_) return;
    may_drop ? server_->post_data(std::move(task)) : server_->post(std::move(task));
    if (may_drop) server_->flush();
  }

  void keep(const std::filesystem::path& recording) {
    try {
      notice_({"the recording that no page has removed is now " + files_.keep(recording, kept_in_).string()});
    } catch (const Error& error) {
      notice_({error.what()});
    }
  }

  Token token_;
  SessionFiles files_;
  std::function<void(const Remark&)> notice_;
  std::filesystem::path kept_in_;
  DashboardSite site_;
  std::mutex sending_;
  bool closed_ = false;  // under sending_
  std::optional<web::Server> server_;
  CallThread calls_;
  RobotThread robot_;
};

Dashboard::Dashboard(const Settings& settings) : impl_(std::make_unique<Impl>(settings)) {}
Dashboard::~Dashboard() = default;

std::uint16_t Dashboard::port() const { return impl_->port(); }
std::filesystem::path Dashboard::file_leading_to(const std::string& link) const {
  return impl_->file_leading_to(link);
}
std::string Dashboard::path_of_link() const { return "/#token=" + impl_->token().text(); }

}  // namespace astro::dashboard
