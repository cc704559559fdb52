#include "host/live/foxglove/foxglove_site.hpp"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "host/live/foxglove/origin.hpp"

namespace astro::foxglove {
namespace {

constexpr std::size_t kLongestOrigin = 200, kMostReported = 20;  // of origins that were refused

/// The newest subprotocol that both sides know; "" if there is none.
std::string subprotocol_of(const web::RequestHead& request) {
  for (const char* ours : {"foxglove.sdk.v1", "foxglove.websocket.v1"})
    if (request.offers(ours)) return ours;
  return "";
}

/// A client of the hub for as long as its connection lasts.
class Viewer : public web::Client {
 public:
  Viewer(Hub& hub, std::string peer, const std::function<void(Remark)>& notice)
      : hub_(hub), session_(hub.join()), peer_(std::move(peer)), notice_(notice) {}
  ~Viewer() override {
    hub_.leave(session_.id());
    try {
      notice_({fmt::format("the viewer at {} has gone", peer_)});
    } catch (const std::exception&) {
    }
  }

  void welcomed() override { notice_({fmt::format("a viewer has connected from {}", peer_)}); }
  void receive(bool is_text, ByteView message) override { session_.receive(is_text, message); }
  web::FrameQueue& queue() override { return session_.queue(); }
  bool watches() const override { return session_.watches(); }
  void dismissed(const Remark& why) override {
    notice_({fmt::format("the viewer at {} was disconnected: {}", peer_, why.sentence), why.kind, {peer_}});
  }

 private:
  Hub& hub_;
  Session& session_;
  std::string peer_;
  const std::function<void(Remark)>& notice_;
};

}  // namespace

web::Decision FoxgloveSite::decide(const web::RequestHead& request) {
  if (const std::string origin(request.field("Origin")); !origin_is_allowed(origin, origins_)) {
    report_refusal(origin.substr(0, kLongestOrigin));
    return web::sentence_response(403, "this page may not look at the robot");
  }
  if (!request.is_upgrade) {
    web::Response response = web::sentence_response(426, "this is a WebSocket for Foxglove");
    response.fields.emplace_back("Upgrade", "websocket");
    return response;
  }
  const std::string subprotocol = subprotocol_of(request);
  if (subprotocol.empty())
    return web::sentence_response(400,
                                  "the subprotocol is neither foxglove.sdk.v1 nor foxglove.websocket.v1");
  return web::Upgrade{
      subprotocol, [this](const std::string& peer) { return std::make_unique<Viewer>(hub_, peer, notice_); }};
}

void FoxgloveSite::report_refusal(const std::string& origin) {
  if (refused_.size() >= kMostReported || !refused_.insert(origin).second) return;
  if (origin_can_be_proposed(origin))
    notice_({fmt::format("a page of '{}' was refused", origin), OriginProblem::refused, {origin}});
  else
    notice_({"a page was refused whose origin no browser gives to a web site", {}});
}

}  // namespace astro::foxglove
