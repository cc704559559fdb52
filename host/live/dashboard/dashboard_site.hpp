#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>

#include "host/live/dashboard/page_client.hpp"
#include "host/live/dashboard/session_files.hpp"
#include "host/live/dashboard/static_files.hpp"
#include "host/live/web/site.hpp"

namespace astro::dashboard {

/// Who may see and do what.
///
///   any request    names this server by localhost or an address; a browser says that it comes from this server's own page, or
///                  from none (the address bar)
///   GET /...       the page's own files, for everybody
///   GET, PUT /files/NAME   with "Authorization: Bearer TOKEN": which no form can send, and no page of another origin without being
///                  allowed to, which nobody is
///   GET /calls     a WebSocket, whose first message is the token
class DashboardSite : public web::Site {
 public:
  static constexpr std::size_t kMostPages = 16;

  struct Hooks {
    std::function<void(Question)> asked;  // also that a page has gone
    std::function<void(const Remark&)> notice;
  };

  DashboardSite(std::filesystem::path page, std::chrono::seconds page_timeout, const Token& token,
                const SessionFiles& files, Hooks hooks)
      : static_files_(std::move(page)),
        page_timeout_(page_timeout),
        token_(token),
        files_(files),
        hooks_(std::move(hooks)) {}

  web::Limits limits() const override;
  web::Decision decide(const web::RequestHead& request) override;
  void notice(const Remark& remark) override { hooks_.notice(remark); }

  /// Sends a text to a page, or to all that are there (0). `may_drop`: if the page does not read fast enough.
  void send(Page page, const std::string& text, bool may_drop);

 private:
  web::Decision decided(const web::RequestHead& request);
  web::Decision file(const web::RequestHead& request, std::string_view name);
  web::Decision upload(const std::filesystem::path& into, std::uint64_t bytes);
  web::Decision calls(const web::RequestHead& request);
  void report_refusal(const std::string& origin);

  StaticFiles static_files_;
  std::chrono::seconds page_timeout_;
  const Token& token_;
  const SessionFiles& files_;
  Hooks hooks_;
  std::map<Page, PageClient*> pages_;  // that have joined
  Page last_page_ = 0;
  std::uint64_t uploads_ = 0;
  std::set<std::string> refused_;  // origins, already reported
};

}  // namespace astro::dashboard
