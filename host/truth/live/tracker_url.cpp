#include "host/truth/live/tracker_url.hpp"

#include <charconv>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"

namespace astro::truth {
namespace {

constexpr std::string_view kMark = "://";

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
    url.scheme = take_until(left_, ":");
    left_.remove_prefix(kMark.size());
    take_place(url);
    if (left_.starts_with('/')) {
      left_.remove_prefix(1);
      url.body = decoded(take_until(left_, "?"));
    }
    if (left_.starts_with('?')) take_options(url);
    if (!left_.empty()) fail("'" + std::string(left_) + "' is left over");
    return url;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Error("'" + std::string(whole_) + "' is not the address of a tracker: " + why);
  }

  void take_place(TrackerUrl& url) {
    if (left_.starts_with('[')) {
      left_.remove_prefix(1);
      url.host = take_until(left_, "]");
      if (left_.empty()) fail("the bracket of its host is not closed");
      left_.remove_prefix(1);
    } else {
      url.host = take_until(left_, ":/?");
    }
    if (url.host.empty()) fail("it has no host");
    if (!left_.starts_with(':')) return;
    left_.remove_prefix(1);
    const std::string_view port = take_until(left_, "/?");
    const auto number = unsigned_in(port);
    if (!number || *number < 1 || *number > 65'535)
      fail("'" + std::string(port) + "' is not a port from 1 to 65535");
    url.port = static_cast<std::uint16_t>(*number);
  }

  void take_options(TrackerUrl& url) {
    left_.remove_prefix(1);
    const std::string_view option = take_until(left_, "&");
    const auto up = option.starts_with("up=") ? up_axis_named(option.substr(3)) : std::nullopt;
    if (!up) fail("'" + std::string(option) + "' is neither up=y nor up=z");
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
        fail("'%' is not followed by two hexadecimal digits");
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
  const std::string name = host.find(':') == std::string::npos ? host : "[" + host + "]";
  return port == 0 ? name : name + ":" + std::to_string(port);
}

bool is_tracker_url(std::string_view text) {
  return text.starts_with("vrpn://") || text.starts_with("natnet://");
}

TrackerUrl tracker_url_in(std::string_view text) {
  if (!is_tracker_url(text))
    throw Error("'" + std::string(text) +
                "' is not the address of a tracker: it begins with neither vrpn:// nor natnet://");
  return Parser(text).parse();
}

}  // namespace astro::truth
