#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/truth/live/sighting.hpp"

namespace astro::truth {

/// A connection to a tracker. It connects, requests what it needs, and reconnects by itself. Only wait()
/// blocks.
class TrackerLink {
 public:
  TrackerLink() = default;
  TrackerLink(const TrackerLink&) = delete;
  TrackerLink& operator=(const TrackerLink&) = delete;
  virtual ~TrackerLink() = default;

  /// Takes what has arrived and does what is due. `now`: on this computer's steady clock.
  virtual void work(std::chrono::microseconds now) = 0;
  /// Returns when something has arrived, or at the latest after `timeout`.
  virtual void wait(std::chrono::microseconds timeout) = 0;

  /// What has come of the body since the last call, oldest first.
  virtual std::vector<Sighting> take() = 0;

  /// Why no pose comes, as far as can be known: a clause.
  virtual std::string why_silent() const = 0;
  /// The bodies of which poses come. With none named in the address, more than one is ambiguous.
  virtual std::vector<std::string> bodies() const = 0;
  virtual const std::string& body() const = 0;
  /// How it is connected: "over TCP".
  virtual std::string way() const = 0;
  /// How often it has connected. The sender's clock may be another one after each time.
  virtual int connections() const = 0;
};

}  // namespace astro::truth
