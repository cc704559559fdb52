#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace astro {

/// Text of at most N bytes in N bytes, without heap or terminator; unused bytes are NUL. A value type. Equal
/// texts have equal bytes, so a text can be stored, sent and compared as it is.
///
/// Encoding  UTF-8 by convention, not checked. A NUL ends the text.
template <std::size_t N>
class Text {
 public:
  static constexpr std::size_t kCapacity = N;

  constexpr Text() = default;

  /// From a literal; one that is too long does not compile.
  template <std::size_t M>
  requires(M <= N + 1) consteval Text(const char (&literal)[M])  // NOLINT(google-explicit-constructor)
      : Text(std::string_view(literal, M - 1)) {}

  /// Keeps the first N bytes. Ask fits() first where losing the rest would matter.
  constexpr explicit Text(std::string_view text) {
    text = text.substr(0, std::min({N, text.size(), text.find('\0')}));
    std::copy(text.begin(), text.end(), characters_.begin());
  }

  static constexpr bool fits(std::string_view text) { return text.size() <= N; }

  constexpr std::string_view view() const { return {characters_.data(), size()}; }
  constexpr bool empty() const { return size() == 0; }
  constexpr std::size_t size() const {
    return static_cast<std::size_t>(std::find(characters_.begin(), characters_.end(), '\0') -
                                    characters_.begin());
  }

  /// All N bytes, padding included.
  constexpr const std::array<char, N>& characters() const { return characters_; }

  constexpr bool operator==(const Text&) const = default;
  constexpr bool operator==(std::string_view other) const { return view() == other; }

 private:
  std::array<char, N> characters_{};
};

}  // namespace astro
