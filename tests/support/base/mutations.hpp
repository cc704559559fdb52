#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace astro::support {

/// Random damage to files: the same sequence for the same seed.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  /// One to four changes: a byte, a cut, a copied stretch, a cell that is something else.
  std::string text(std::string text) {
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(text);
    return text;
  }

  /// One to eight bytes, half of them in the first page, where the headers are; sometimes a cut, or bytes between.
  std::vector<std::uint8_t> bytes(std::vector<std::uint8_t> bytes) {
    constexpr std::size_t kPage = 4096;
    for (std::size_t edits = 1 + below(8); edits > 0; --edits) {
      const std::size_t at = below(2) == 0 ? below(std::min(bytes.size(), kPage)) : below(bytes.size());
      bytes[at] = below(3) == 0 ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(below(256));
    }
    if (below(4) == 0) bytes.resize(1 + below(bytes.size()));
    if (below(8) == 0)
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size())), 7, 0xFF);
    return bytes;
  }

 private:
  std::size_t below(std::size_t size) {
    return size == 0 ? 0 : std::uniform_int_distribution<std::size_t>(0, size - 1)(random_);
  }

  void change(std::string& text) {
    static const std::vector<std::string> kCells = {"",
                                                    "nan",
                                                    "1e308",
                                                    "-0",
                                                    "\"",
                                                    ",",
                                                    ";",
                                                    "\n",
                                                    "\r",
                                                    "1e-9",
                                                    "9e999",
                                                    "Frame",
                                                    "mm",
                                                    "#",
                                                    "rad",
                                                    "Marker",
                                                    "99999999999999999999",
                                                    "[",
                                                    "{",
                                                    ": "};
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0:
        text.insert(at, 1, static_cast<char>(below(256)));
        return;
      case 1:
        text.erase(at, 1 + below(40));
        return;
      case 2:
        text.insert(at, text.substr(below(text.size()), below(200)));
        return;
      case 3:
        text.insert(at, kCells[below(kCells.size())]);
        return;
      default:
        const std::size_t end = text.find_first_of(",;\n ", at);
        text.replace(at, end == std::string::npos ? 0 : end - at, kCells[below(kCells.size())]);
    }
  }

  std::mt19937 random_;
};

}  // namespace astro::support
