#pragma once

#include <cstdint>
#include <filesystem>

namespace astro::importing {

/// What is wrong with the samples of a bag. Values: the bag, and what they are.
enum class SampleProblem { too_many };

/// Throws astro::Error naming the bag if it holds more samples than a file of its size can hold: more than
/// 300,000, plus one for each `least_bytes` of its files. Messages of a robot that stands still compress
/// best, because they differ only in their times: to 26 bytes a message; those of a robot that drives take 50
/// and more. `what` names the samples, for example "poses".
void require_possible(std::uint64_t samples, std::uint64_t least_bytes, const char* what,
                      const std::filesystem::path& path);

}  // namespace astro::importing
