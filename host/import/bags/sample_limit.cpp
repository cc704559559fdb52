#include "host/import/bags/sample_limit.hpp"

#include <string>

#include "host/base/error.hpp"
#include "host/formats/files/bag_files.hpp"

namespace astro::importing {

void require_possible(std::uint64_t samples, std::uint64_t least_bytes, const char* what,
                      const std::filesystem::path& path) {
  constexpr std::uint64_t kFreeSamples = 300'000;
  std::uint64_t bytes = 0;
  for (const std::filesystem::path& file : bag::bag_files(path).files)
    bytes += std::filesystem::file_size(file);
  if (samples > kFreeSamples + bytes / least_bytes)
    throw Error(path.string() + " holds more " + what +
                    " than are taken from a file of its size: copy it again from where it was recorded, or "
                    "record the run again",
                SampleProblem::too_many, {path.string(), what});
}

}  // namespace astro::importing
