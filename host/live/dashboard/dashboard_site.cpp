#include "host/live/dashboard/dashboard_site.hpp"

#include <fmt/format.h>

#include <memory>
#include <system_error>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/live/web/origin.hpp"

namespace astro::dashboard {
namespace {

namespace fs = std::filesystem;
using web::sentence_response;

constexpr std::size_t kMostReported = 20;  // of origins that were refused

std::string_view path_of(const web::RequestHead& request) {
  const std::string_view target = request.target;
  return target.substr(0, target.find_first_of("?#"));
}

/// Whether a browser says that another page wants this. Programs that are no browsers say nothing.
bool is_foreign(const web::RequestHead& request) {
  const std::string_view origin = request.field("Origin");
  return !origin.empty() && !web::is_same_origin(origin, request.field("Host"));
}

/// A link or an address that somebody opens is of no page, or of any: what it shows has no secrets.
bool is_cross_site(const web::RequestHead& request) {
  const std::string_view from = request.field("Sec-Fetch-Site");
  return from == "cross-site" || from == "same-site";
}

}  // namespace

web::Limits DashboardSite::limits() const {
  web::Limits limits;
  limits.idle_s = static_cast<int>(page_timeout_.count());
  return limits;
}

web::Decision DashboardSite::decide(const web::RequestHead& request) {
  web::Decision decision = decided(request);
  if (auto* response = std::get_if<web::Response>(&decision))
    for (const auto& field : guarding_fields()) response->fields.push_back(field);
  return decision;
}

web::Decision DashboardSite::decided(const web::RequestHead& request) {
  if (!web::host_is_ours(request.field("Host")))
    return sentence_response(421, "this server is called localhost, or by its address");
  if (is_foreign(request)) {
    report_refusal(std::string(request.field("Origin")));
    return sentence_response(403, "this page may neither see nor drive the robot");
  }
  constexpr std::string_view kFiles = "/files/";
  const std::string_view path = path_of(request);
  if (path == "/calls") return calls(request);
  if (path.starts_with(kFiles)) return file(request, path.substr(kFiles.size()));
  if (request.method != "GET") return sentence_response(405, "only GET is possible here");
  return static_files_.find(path);
}

web::Decision DashboardSite::calls(const web::RequestHead& request) {
  if (is_cross_site(request)) return sentence_response(403, "this page may neither see nor drive the robot");
  if (!request.is_upgrade) {
    web::Response response = sentence_response(426, "this is a WebSocket");
    response.fields.emplace_back("Upgrade", "websocket");
    return response;
  }
  return web::Upgrade{
      "", [this](const std::string&) {
        return std::make_unique<PageClient>(
            ++last_page_, token_,
            PageClient::Hooks{[this] {
                                return pages_.size() < kMostPages
                                           ? std::string()
                                           : fmt::format("{} pages are open already: close one of them",
                                                         kMostPages);
                              },
                              [this](PageClient& page) { pages_[page.page()] = &page; }, hooks_.asked,
                              [this](PageClient& page) {
                                pages_.erase(page.page());
                                hooks_.asked({page.page(), 0, std::string(kPageGone)});
                              }});
      }};
}

web::Decision DashboardSite::file(const web::RequestHead& request, std::string_view name) {
  constexpr std::string_view kBearer = "Bearer ";
  const std::string_view given = request.field("Authorization");
  if (is_cross_site(request) || !given.starts_with(kBearer) || !token_.is(given.substr(kBearer.size())))
    return sentence_response(401, "the token of this session is needed");
  const auto decoded = percent_decoded(name);
  if (request.method == "PUT") {
    const auto into = decoded ? files_.place_of(*decoded) : std::nullopt;
    if (!into) return sentence_response(400, "this is no name of a file: give one without folders");
    std::string_view length = request.field("Content-Length");
    return upload(*into, take_number<std::uint64_t>(length).value_or(0));
  }
  if (request.method != "GET") return sentence_response(405, "only GET and PUT are possible here");
  const auto found = decoded ? files_.find(*decoded) : std::nullopt;
  if (!found) return sentence_response(404, "there is no such file");
  return web::Response{200, {{"Content-Type", "application/octet-stream"}}, {}, *found};
}

/// The file gets its name once it is whole, so no call reads half of one.
web::Decision DashboardSite::upload(const fs::path& into, std::uint64_t bytes) {
  const std::uint64_t room = files_.room();
  if (bytes > room)
    return sentence_response(507, "the files of this session take all the room that there is for them");
  const fs::path part = files_.folder() / fmt::format(".upload-{}", ++uploads_);
  return web::Upload{part, room,
                     [part, into]() -> web::Response {
                       std::error_code failed;
                       fs::rename(part, into, failed);
                       web::Response response =
                           failed ? sentence_response(500, "the file cannot be written") : web::Response{204};
                       for (const auto& field : guarding_fields()) response.fields.push_back(field);
                       return response;
                     },
                     [part] {
                       std::error_code ignored;
                       fs::remove(part, ignored);
                     }};
}

void DashboardSite::report_refusal(const std::string& origin) {
  if (refused_.size() >= kMostReported || !refused_.insert(origin).second) return;
  hooks_.notice({web::origin_can_be_proposed(origin)
                     ? fmt::format("a page of '{}' was refused", origin)
                     : "a page was refused whose origin no browser gives to a web site"});
}

void DashboardSite::send(Page page, const std::string& text, bool may_drop) {
  const web::SharedSample shared =
      may_drop ? std::make_shared<const web::Sample>(web::Sample{0, Bytes(text.begin(), text.end())})
               : nullptr;
  for (auto& [number, client] : pages_) {
    if (page != 0 && page != number) continue;
    may_drop ? client->send_data(shared) : client->send(text);
  }
}

}  // namespace astro::dashboard
