#include "host/console/keys.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

namespace astro::console {
namespace {

constexpr char kEscape = '\033';

std::optional<Key> letter(char byte) {
  switch (std::tolower(static_cast<unsigned char>(byte))) {
    case 'w':
      return Key::forward;
    case 's':
      return Key::backward;
    case 'a':
      return Key::left;
    case 'd':
      return Key::right;
    case ' ':
      return Key::stop;
    case 'q':
      return Key::quit;
    default:
      return std::nullopt;
  }
}

std::optional<Key> arrow(char byte) {
  constexpr Key kArrows[] = {Key::forward, Key::backward, Key::right, Key::left};  // A B C D
  if (byte < 'A' || byte > 'D') return std::nullopt;
  return kArrows[byte - 'A'];
}

// A control sequence continues up to its final byte: ECMA-48, 5.4.
bool ends_sequence(char byte) { return byte >= '@' && byte <= '~'; }

}  // namespace

std::vector<Key> KeyReader::read(std::string_view bytes) {
  std::vector<Key> keys;
  const auto take = [&](std::optional<Key> key) {
    if (key) keys.push_back(*key);
  };
  for (const char byte : bytes) {
    if (byte == kEscape) {
      escape_ = byte;
    } else if (escape_.empty()) {
      take(letter(byte));
    } else if (escape_.size() == 1) {
      const bool begins_sequence = byte == '[' || byte == 'O';
      escape_ = begins_sequence ? escape_ + byte : "";
      if (!begins_sequence) take(letter(byte));  // a lone Escape before it
    } else if (ends_sequence(byte)) {
      if (escape_.size() == 2) take(arrow(byte));
      escape_.clear();
    } else {
      escape_ += byte;
    }
  }
  return keys;
}

void SteeringWheel::press(Key key) {
  const auto move = [](int& steps, int by) { steps = std::clamp(steps + by, -kSteps, kSteps); };
  switch (key) {
    case Key::forward:
      return move(forward_, 1);
    case Key::backward:
      return move(forward_, -1);
    case Key::left:
      return move(left_, 1);
    case Key::right:
      return move(left_, -1);
    case Key::stop:
    case Key::quit:
      forward_ = left_ = 0;
  }
}

}  // namespace astro::console
