#include "host/truth/live/tracker_url.hpp"

#include <charconv>
#include <optional>
#include <set>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/formats/cdr/names.hpp"

namespace astro::truth {
namespace {

constexpr std::string_view kMark = "://", kRos = "ros2:";

/// Takes what comes before the first of `ends` off the front of the text.
std::string_view take_until(std::string_view& text, std::string_view ends) {
  const std::string_view part = text.substr(0, text.find_first_of(ends));
  text.remove_prefix(part.size());
  return part;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : whole_(text), left_(text) {}

  TrackerUrl parse() {
    TrackerUrl url;
    if (left_.starts_with(kRos)) return parse_ros();
    url.scheme = take_until(left_, ":");
    left_.remove_prefix(kMark.size());
    take_place(url);
    if (left_.starts_with('/')) {
      left_.remove_prefix(1);
      url.body = decoded(take_until(left_, "?"));
    }
    if (left_.starts_with('?')) take_options(url);
    if (!left_.empty()) fail("'" + std::string(left_) + "' is left over", UrlProblem::left_over, left_);
    return url;
  }

 private:
  TrackerUrl parse_ros() {
    TrackerUrl url;
    url.scheme = take_until(left_, ":");
    left_.remove_prefix(1);
    if (left_.starts_with("//"))
      fail("a topic of ROS 2 is on no host, so it has one slash in front, as ros2:/mocap/robot/pose",
           UrlProblem::topic_on_host);
    url.topic = take_until(left_, "?");
    if (!ros2::is_full_name(url.topic))
      fail("'" + url.topic + "' is not the full name of a topic, as /mocap/robot/pose",
           UrlProblem::topic_malformed, url.topic);
    std::set<std::string_view> given;
    while (!left_.empty()) {
      left_.remove_prefix(1);
      const std::string_view option = take_until(left_, "&");
      const std::string_view name = option.substr(0, option.find('='));
      if (name.size() == option.size() || !take_ros_option(url, name, option.substr(name.size() + 1)))
        fail("'" + std::string(option) +
                 "' is none of child=FRAME, parent=FRAME, up=y, up=z, domain=0 to 232, range=localhost and "
                 "range=subnet",
             UrlProblem::option_unknown, option);
      if (!given.insert(name).second)
        fail("it has " + std::string(name) + "= twice", UrlProblem::option_twice, name);
    }
    return url;
  }

  /// Returns false if there is no such option, or not with this value.
  bool take_ros_option(TrackerUrl& url, std::string_view name, std::string_view value) const {
    if (name == "child") return !(url.body = decoded(value)).empty();
    if (name == "parent") return !(url.parent = decoded(value)).empty();
    if (name == "up") {
      const auto up = up_axis_named(value);
      url.up = up.value_or(url.up);
      return up.has_value();
    }
    if (name == "domain") {
      const auto domain = unsigned_in(value);
      if (!domain || *domain > dds::kMostDomains) return false;
      url.where.domain = static_cast<int>(*domain);
      return true;
    }
    if (name != "range") return false;
    url.where.range = dds::range_in(std::string(value));
    return url.where.range && *url.where.range != dds::Range::off;
  }

  [[noreturn]] void fail(const std::string& why, UrlProblem problem,
                         std::optional<std::string_view> part = {}) const {
    std::vector<std::string> values{std::string(whole_)};
    if (part) values.emplace_back(*part);
    throw Error("'" + values[0] + "' is not the address of a tracker: " + why, problem, values);
  }

  void take_place(TrackerUrl& url) {
    if (left_.starts_with('[')) {
      left_.remove_prefix(1);
      url.host = take_until(left_, "]");
      if (left_.empty()) fail("the bracket of its host is not closed", UrlProblem::bracket_open);
      left_.remove_prefix(1);
    } else {
      url.host = take_until(left_, ":/?");
    }
    if (url.host.empty()) fail("it has no host", UrlProblem::no_host);
    if (!left_.starts_with(':')) return;
    left_.remove_prefix(1);
    const std::string_view port = take_until(left_, "/?");
    const auto number = unsigned_in(port);
    if (!number || *number < 1 || *number > 65'535)
      fail("'" + std::string(port) + "' is not a port from 1 to 65535", UrlProblem::port_impossible, port);
    url.port = static_cast<std::uint16_t>(*number);
  }

  void take_options(TrackerUrl& url) {
    left_.remove_prefix(1);
    const std::string_view option = take_until(left_, "&");
    const auto up = option.starts_with("up=") ? up_axis_named(option.substr(3)) : std::nullopt;
    if (!up)
      fail("'" + std::string(option) + "' is neither up=y nor up=z", UrlProblem::up_axis_unknown, option);
    url.up = *up;
  }

  std::string decoded(std::string_view text) const {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '%') {
        plain += text[i];
        continue;
      }
      unsigned char code = 0;
      const char* first = text.data() + i + 1;
      if (i + 2 >= text.size() || std::from_chars(first, first + 2, code, 16).ptr != first + 2)
        fail("'%' is not followed by two hexadecimal digits", UrlProblem::escape_malformed);
      plain += static_cast<char>(code);
      i += 2;
    }
    return plain;
  }

  std::string_view whole_, left_;
};

}  // namespace

TrackerUrl TrackerUrl::with_usual_port(std::uint16_t usual) const {
  TrackerUrl url = *this;
  if (url.port == 0) url.port = usual;
  return url;
}

std::string TrackerUrl::place() const {
  if (!topic.empty()) return "ROS 2";
  const std::string name = host.find(':') == std::string::npos ? host : "[" + host + "]";
  return port == 0 ? name : name + ":" + std::to_string(port);
}

bool is_tracker_url(std::string_view text) {
  return text.starts_with("vrpn://") || text.starts_with("natnet://") || text.starts_with(kRos);
}

TrackerUrl tracker_url_in(std::string_view text) {
  if (!is_tracker_url(text))
    throw Error("'" + std::string(text) +
                    "' is not the address of a tracker: it begins with none of vrpn://, natnet:// and ros2:/",
                UrlProblem::scheme_unknown, {std::string(text)});
  return Parser(text).parse();
}

}  // namespace astro::truth
