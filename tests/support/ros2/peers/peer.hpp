#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// A program that stands for somebody else's ROS 2 node: what it is told comes in lines, and what it sees goes out in lines
/// (README.md).
namespace astro::support {

struct Answer {
  bool success = false;
  std::string text;
};

/// What a peer can do, whichever DDS it is made of. Calls wait some seconds at most, and return nothing if no answer came.
class Peer {
 public:
  Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  virtual ~Peer() = default;

  /// `kind`: a type, as the README lists them. False if there is none of that name.
  virtual bool subscribe(const std::string& topic, const std::string& kind, bool latched) = 0;
  /// The writers of a topic that has been subscribed: "GUID user_data".
  virtual std::vector<std::string> writers_of(const std::string& topic) = 0;
  /// What participants show of themselves; nothing for a peer that cannot see it.
  virtual std::vector<std::string> participants() { return {}; }
  /// False if nobody reads the topic, after a wait: what is written before a reader has been found would be lost.
  virtual bool twist(const std::string& topic, double v_mps, double w_radps) = 0;
  virtual bool twist_stamped(const std::string& topic, double v_mps, double w_radps,
                             std::int64_t stamp_ns) = 0;
  virtual bool pose(const std::string& topic, const std::string& frame, double x_m, double y_m,
                    double heading_rad) = 0;

  virtual std::optional<Answer> trigger(const std::string& service) = 0;
  virtual std::optional<Answer> set_bool(const std::string& service, bool data) = 0;
  /// `value`: a word, as `ros2 param` takes and shows it. Empty texts for a parameter that is not there.
  virtual std::optional<Answer> get(const std::string& node, const std::string& name) = 0;
  virtual std::optional<Answer> set(const std::string& node, const std::string& name,
                                    const std::string& value) = 0;
  virtual std::optional<Answer> list(const std::string& node, const std::string& prefix,
                                     std::uint64_t depth) = 0;
  virtual std::optional<Answer> describe(const std::string& node, const std::string& name) = 0;

  /// Calls `got` for what has come.
  using OnSample =
      std::function<void(const std::string& topic, const std::string& kind, const std::string& text)>;
  virtual void take(const OnSample& got) = 0;
};

/// Reads commands from standard input until it ends or says `quit`, and prints what comes of them and of the topics.
int run(Peer& peer);

}  // namespace astro::support
