#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>

namespace astro::dashboard {

/// The secret of one session, 128 bits: whoever says it may drive the robot.
class Token {
 public:
  Token() {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::random_device random;
    for (int word = 0; word < 4; ++word) {
      std::uint32_t bits = random();
      for (int digit = 0; digit < 8; ++digit, bits >>= 4) text_ += kDigits[bits & 15U];
    }
  }

  const std::string& text() const { return text_; }

  /// Takes as long for a guess that is nearly right as for any other.
  bool is(std::string_view guess) const {
    if (guess.size() != text_.size()) return false;
    unsigned differs = 0;
    for (std::size_t i = 0; i < text_.size(); ++i)
      differs |= static_cast<unsigned char>(guess[i]) ^ static_cast<unsigned char>(text_[i]);
    return differs == 0;
  }

 private:
  std::string text_;
};

}  // namespace astro::dashboard
