#pragma once

namespace astro::recording {

/// Why a file or a folder is no recording. Values: the file or the folder; then what the system says
/// (folder_unreadable), the entry's key (bad_entry), or the time in microseconds (time_out_of_range).
/// Of turned_unseen, which is a remark on a run: its name, then for each turn the degrees and the seconds after the start.
enum class RecordingProblem {
  not_mcap,
  of_no_run,
  of_newer_version,
  bad_entry,
  cut_off,
  too_many_samples,
  poses_without_counts,
  time_out_of_range,
  none_in_folder,
  folder_missing,
  folder_is_file,
  folder_unreadable,
  turned_unseen
};

}  // namespace astro::recording
