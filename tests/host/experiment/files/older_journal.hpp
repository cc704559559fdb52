#pragma once

#include <filesystem>

namespace astro::test {

/// Makes of the experiment.json in `folder` what a version wrote that knew neither e nor several circles.
void make_older_than_e(const std::filesystem::path& folder);

}  // namespace astro::test
