#pragma once

#include <filesystem>

#include "host/base/bytes.hpp"
#include "host/base/descriptor.hpp"

namespace astro {

/// Bytes that are read where they are needed, so that a file of any size takes no memory of its size.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  virtual std::uint64_t size() const = 0;
  /// `count` bytes at `offset`, valid until the next call. Precondition: they lie within size().
  virtual ByteView read(std::uint64_t offset, std::size_t count) = 0;
};

class MemorySource : public ByteSource {
 public:
  explicit MemorySource(ByteView bytes) : bytes_(bytes) {}

  std::uint64_t size() const override { return bytes_.size(); }
  ByteView read(std::uint64_t offset, std::size_t count) override {
    return bytes_.subspan(static_cast<std::size_t>(offset), count);
  }

 private:
  ByteView bytes_;
};

/// A regular file, read through a window of 1 MiB, or of the largest `count` if that is more. Its size is the one
/// that it had when it was opened: what a recorder appends later is not seen.
///
/// Errors  astro::Error naming the file: as require_file (files.hpp), or if it cannot be read, also because it became
///         shorter in the meantime.
class FileSource : public ByteSource {
 public:
  explicit FileSource(std::filesystem::path path);

  std::uint64_t size() const override { return size_; }
  ByteView read(std::uint64_t offset, std::size_t count) override;

 private:
  std::filesystem::path path_;
  Descriptor descriptor_;
  std::uint64_t size_ = 0;
  std::uint64_t window_start_ = 0;
  Bytes window_;
};

}  // namespace astro
