#pragma once

namespace astro {

/// What is wrong with a file or a folder. Values: its path; then its size and the limit (too_large), the
/// first byte that is zero (not_plain_text) or the first byte of the line (line_too_long), both counted from
/// 1, what the system says (unreadable), or the kind that it should have (of_other_kind).
enum class FileProblem {
  missing,
  unfinished,
  unreadable,
  unwritable,
  is_folder,
  is_device_or_pipe,
  is_link,
  is_recording,
  is_input,
  of_other_kind,
  too_large,
  not_plain_text,
  line_too_long,
  in_use,
  folder_not_made,
  folder_in_use
};

}  // namespace astro
