#include "host/import/drives/text_file.hpp"

#include <algorithm>

#include "host/base/byte_source.hpp"
#include "host/base/files.hpp"
#include "host/formats/files/bag_files.hpp"
#include "host/truth/files/packed_text.hpp"

namespace astro::importing {
namespace {

namespace fs = std::filesystem;

}  // namespace

bool is_packed_text(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  FileSource file(path);
  return truth::is_gzip(file.read(0, static_cast<std::size_t>(std::min<std::uint64_t>(file.size(), 3))));
}

Bytes text_of_file(const fs::path& path) {
  bag::require_bag_content(path);
  if (!is_packed_text(path)) return load_text(path);
  FileSource file(path);
  return truth::unpacked(file, path.string());
}

}  // namespace astro::importing
