#pragma once

#include <string>
#include <vector>

#include "host/simulation/study/setup.hpp"
#include "host/simulation/study/trial.hpp"

/// The trials of one shard as text, and several shards merged.
namespace astro::simulation::study {

/// What is wrong with a shard of a study, or with several of them.
enum class StudyProblem {
  not_a_shard,             // value: the file
  shard_of_other_version,  // the same
  shard_damaged,           // values: the file, the trial that it holds, and how many the study has
  shard_empty,             // values: the number of the shard, of how many, and of how many trials
  no_shards,
  of_two_studies,  // values: a file, what differs and its value there, another file and the value in it
  trial_twice,     // values: the trial and both files
  trials_missing   // values: how many there are, and the first and the last that is missing
};

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
