#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "host/live/foxglove/hub.hpp"
#include "host/live/web/site.hpp"

namespace astro::foxglove {

/// A WebSocket with the right subprotocol for pages of allowed origins, and nothing else: each becomes a client of the hub.
class FoxgloveSite : public web::Site {
 public:
  /// `origins`: allowed in addition to the usual ones (origin.hpp). `hub` must outlive it.
  FoxgloveSite(Hub& hub, std::vector<std::string> origins, std::function<void(Remark)> notice)
      : hub_(hub), origins_(std::move(origins)), notice_(std::move(notice)) {}

  web::Decision decide(const web::RequestHead& request) override;
  void report() override { hub_.report(); }
  void notice(const Remark& remark) override { notice_(remark); }

 private:
  void report_refusal(const std::string& origin);

  Hub& hub_;
  std::vector<std::string> origins_;
  std::set<std::string> refused_;  // already reported, because a page may try again and again
  std::function<void(Remark)> notice_;
};

}  // namespace astro::foxglove
