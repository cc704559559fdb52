#include "host/recording/foreign/line_reader.hpp"

#include <algorithm>
#include <cstring>

#include "host/base/formats/csv_table.hpp"

namespace astro::recording {

std::optional<std::string_view> LineReader::next() {
  constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 10;
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (at_ >= file_.size()) return std::nullopt;
  ++line_;
  const auto count = static_cast<std::size_t>(std::min(file_.size() - at_, kMostBytes));
  std::string_view text = as_text(file_.read(at_, count));
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos && count == kMostBytes)
    refuse(name_, line_, "the line has more than 65536 characters");
  at_ += end == std::string_view::npos ? count : end + 1;
  text = text.substr(0, end);
  if (std::memchr(text.data(), 0, text.size()) != nullptr) refuse(name_, line_, "this is not text");
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  if (line_ == 1 && text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

}  // namespace astro::recording
