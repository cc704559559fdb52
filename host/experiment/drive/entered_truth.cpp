#include "host/experiment/drive/entered_truth.hpp"
#include "host/experiment/drive/open_journal.hpp"

#include "host/base/error.hpp"
#include "host/experiment/files/experiment_folder.hpp"
#include "host/recording/run_file.hpp"

namespace astro::experiment {

namespace fs = std::filesystem;

bool EnteredTruth::keep(const RunSpec& spec, recording::Run& run) {
  const fs::path driven = file_without_truth(folder_, spec);
  bool complete = true;
  if (truth_.comes_afterwards()) {
    recording::write_run(driven, run);
    complete = ask(run, "; the drive is kept");
  }
  if (complete) recording::write_run(file_of(folder_, spec), run);
  fs::remove(driven);
  return complete;
}

bool EnteredTruth::ask(recording::Run& run, const char* what_is_left) {
  try {
    return complete(run, truth_);
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    throw Error(std::string(error.what()) + what_is_left, ExperimentProblem::truth_missing, {error.what()});
  }
}

void EnteredTruth::look_back(const std::vector<RunSpec>& specs) {
  if (!truth_.comes_afterwards()) return;
  while (const std::optional<DoubtfulRun> odd = most_doubtful(specs)) {
    const Redo redo = hooks_.doubt(*odd);
    if (redo != Redo::no) {
      correct(odd->spec, redo);
      continue;
    }
    journal_.confirmed.insert(name_in_folder(odd->spec));
    write_journal(folder_, journal_);
  }
}

std::optional<DoubtfulRun> EnteredTruth::most_doubtful(const std::vector<RunSpec>& specs) {
  const RunSpec* missing = first_missing(folder_, specs);
  const std::size_t count =
      missing == nullptr ? specs.size() : static_cast<std::size_t>(missing - specs.data());
  if (count < recordings_.size()) recordings_.start();
  for (const DoubtfulRun& run : recordings_.doubtful(std::span(specs).first(count)))
    if (!journal_.confirmed.contains(name_in_folder(run.spec))) return run;
  return std::nullopt;
}

std::string EnteredTruth::name_in_folder(const RunSpec& spec) const {
  return file_of(folder_, spec).lexically_relative(folder_).generic_string();
}

void EnteredTruth::correct(const RunSpec& spec, Redo redo) {
  if (redo == Redo::no) return;
  const fs::path file = file_of(folder_, spec);
  recording::Run run = recording::read_run(file);
  run.truth.clear();
  if (redo == Redo::enter_again && ask(run, "; what was entered before is kept")) {
    recording::write_run(file, run);
  } else {
    fs::remove(file);
  }
  journal_.confirmed.erase(name_in_folder(spec));
  write_journal(folder_, journal_);
  recordings_.start();
}

}  // namespace astro::experiment
