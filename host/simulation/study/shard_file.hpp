#pragma once

#include <string>
#include <vector>

#include "host/simulation/study/setup.hpp"
#include "host/simulation/study/trial.hpp"

/// The trials of one shard as text, and several shards merged.
namespace astro::simulation::study {

/// What is wrong with a shard of a study.
enum class StudyProblem { not_a_shard, shard_of_other_version, shard_damaged };

struct ShardFile {
  std::string name;  // of the file, for messages
  TrialSetup setup;
  std::vector<Trial> trials;
};

/// JSON; every number reads back to the last bit. NaN and infinity are words ("nan"), because null means a
/// method without an answer.
std::string to_text(const TrialSetup& setup, const std::vector<Trial>& trials);

/// Throws astro::Error naming the file if the text is no such JSON.
ShardFile read_shard_file(const std::string& text, const std::string& name);

/// All trials of the study in order.
///
/// Throws astro::Error if there are no parts, if two set-ups differ (says in what), if two parts hold the
/// same trials, or if trials are missing (says which).
std::vector<Trial> merge(const std::vector<ShardFile>& parts);

}  // namespace astro::simulation::study
