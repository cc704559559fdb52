#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <string>

#include "tests/support/base/places.hpp"

/// Recordings of real trackers, which lie beside a developer's checkout only.
namespace astro::test {

inline std::string shared_file(const std::string& path) { return support::shared_data() / path; }

/// The text of a file, unpacked if it is one of gzip.
inline std::string text_of_file(const std::string& path) {
  std::string text;
  const gzFile file = gzopen(path.c_str(), "rb");
  char buffer[65536];
  for (int count = 0; (count = gzread(file, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(count));
  gzclose(file);
  return text;
}

#define SKIP_WITHOUT(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "there is no file " << (path)

}  // namespace astro::test
