#include "host/base/text/natural_order.hpp"

#include <algorithm>

namespace astro {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Cuts a run of digits, or one other character, off the front.
std::string_view take_piece(std::string_view& text) {
  std::size_t size = 1;
  while (is_digit(text[0]) && size < text.size() && is_digit(text[size])) ++size;
  const std::string_view piece = text.substr(0, size);
  text.remove_prefix(size);
  return piece;
}

int compare_pieces(std::string_view a, std::string_view b) {
  if (!is_digit(a[0]) || !is_digit(b[0])) return a.compare(b);
  a.remove_prefix(std::min(a.find_first_not_of('0'), a.size()));
  b.remove_prefix(std::min(b.find_first_not_of('0'), b.size()));
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  return a.compare(b);
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  std::string_view rest_a = a;
  std::string_view rest_b = b;
  while (!rest_a.empty() && !rest_b.empty()) {
    const std::string_view piece_a = take_piece(rest_a);
    const std::string_view piece_b = take_piece(rest_b);
    if (const int order = compare_pieces(piece_a, piece_b); order != 0) return order < 0;
  }
  if (rest_a.empty() != rest_b.empty()) return rest_a.empty();
  return a < b;  // "1" and "01"
}

}  // namespace astro
