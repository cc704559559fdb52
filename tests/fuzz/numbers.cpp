// Numbers of the command line: what a check lets through is read without loss.
#include <cmath>

#include "host/base/text/numbers.hpp"
#include "host/base/text/plain_text.hpp"
#include "host/console/options.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  const std::string text(text_of(input));
  for (const console::Check& check :
       {console::between(-3, 5, "m"), console::positive("s"), console::finite(), console::fraction()}) {
    std::string word = text;
    if (!check(word).empty()) continue;
    const std::string_view digits = std::string_view(word).substr(word.starts_with('+') ? 1 : 0);
    const auto value = number_in(digits);
    require(value && std::isfinite(*value), "a number that was let through is finite");
  }
  std::string word = text;
  if (console::whole(1, 1000)(word).empty())
    require(std::stoull(word) >= 1 && std::stoull(word) <= 1000,
            "a count that was let through is within its limits");
  const std::string plain = plain_text(text);
  require(plain_text(plain) == plain, "plain text is plain");
  for (const char c : plain)
    require(static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t',
            "plain text holds no control characters");
}

std::vector<Bytes> seeds() {
  return {bytes_of("1"),     bytes_of("+0.5"), bytes_of("-3e-2"), bytes_of("0.05%"), bytes_of("nan"),
          bytes_of("1e309"), bytes_of("0x10"), bytes_of(" 7"),    bytes_of("1000")};
}

}  // namespace astro::fuzz
