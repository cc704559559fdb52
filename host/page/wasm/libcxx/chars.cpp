#include "host/page/wasm/libcxx/chars.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace std {
namespace {

template <class T>
from_chars_result number(const char* first, const char* last, T& value) {
  const auto [end, error] = fast_float::from_chars(first, last, value);
  return {end, error};
}

}  // namespace

from_chars_result from_chars(const char* first, const char* last, double& value) {
  return number(first, last, value);
}

from_chars_result from_chars(const char* first, const char* last, float& value) {
  return number(first, last, value);
}

to_chars_result _LIBCPP_ABI_NAMESPACE::to_chars(char* first, char* last, double value) {
  const string text = fmt::format("{}", value);
  if (static_cast<size_t>(last - first) < text.size()) return {last, errc::value_too_large};
  return {std::copy(text.begin(), text.end(), first), errc{}};
}

}  // namespace std
