#pragma once

#include <string>
#include <vector>

#include "host/simulation/study/setup.hpp"
#include "host/simulation/study/trial.hpp"

/// The trials of one shard as text, and several of them together again.
namespace astro::simulation::study {

struct Part {
  std::string name;  // of the file, for messages
  TrialSetup setup;
  std::vector<Trial> trials;
};

/// JSON; every number comes back to the last bit. What is no number or infinite is a word there ("nan"): null
/// is a method without an answer.
std::string to_text(const TrialSetup& setup, const std::vector<Trial>& trials);

/// Throws astro::Error naming the file if the text is no such JSON.
Part read_part(const std::string& text, const std::string& name);

/// All trials of the study in order.
///
/// Throws astro::Error if there are no parts, if two set-ups differ (says in what), if two parts hold the
/// same trials, or if trials are missing (says which).
std::vector<Trial> merge(const std::vector<Part>& parts);

}  // namespace astro::simulation::study
