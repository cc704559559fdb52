#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "host/base/byte_source.hpp"

namespace astro::recording {

/// The lines of a text file of any size, without their line ends (LF or CRLF) and a byte order mark.
class LineReader {
 public:
  LineReader(ByteSource& file, std::string name) : file_(file), name_(std::move(name)) {}

  /// Nothing after the last line. The text is valid until the next call. Throws astro::Error naming the file and the
  /// line if a line has more than 64 KiB or a NUL byte.
  std::optional<std::string_view> next();
  int line() const { return line_; }  // of the last one, from 1

 private:
  ByteSource& file_;
  std::string name_;
  std::uint64_t at_ = 0;
  int line_ = 0;
};

}  // namespace astro::recording
