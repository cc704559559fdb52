#pragma once

#include <filesystem>
#include <vector>

#include "host/commands/shared/film_options.hpp"
#include "host/console/command_line.hpp"
#include "host/import/drives/stated_drives.hpp"

/// Options of commands that take drives which other programs recorded.
namespace astro::commands {

/// A truth may be a film, "film:FILE".
struct ImportOptions : importing::StatedDrives {
  bool session_per_folder = false;
  FilmOptions film_figures;  // of truths that are films

  /// The truths that are films ("film:FILE").
  std::vector<std::filesystem::path> films() const;
  /// Whether drives of other programs are named. A film alone may be the truth of recordings in a folder.
  bool given() const { return !wheels.empty() || truth.size() > films().size(); }
};

/// --wheels and --truth, each as often as there are drives.
void add_drive_files(console::Command command, ImportOptions& options);

/// Options for reading files of these kinds. What they leave open is recognised, or an error asks for it.
void add_table_choices(console::Command command, ImportOptions& options);
void add_bag_choices(console::Command command, ImportOptions& options);
void add_bag_truth_choices(console::Command command, ImportOptions& options);
void add_body_choice(console::Command command, ImportOptions& options);
void add_tracker_choices(console::Command command, ImportOptions& options);
void add_geometry_choices(console::Command command, ImportOptions& options);

/// What the options state about the files of drives. Throws console::WrongUsage for a list of the wrong length, and what
/// importing::read_robot_file throws.
importing::ImportChoices choices_of(const ImportOptions& options);

/// Films as the truth of recordings of this project; nothing if none is named. Throws as commands::give_truth does.
void give_films(experiment::RunSet& set, const ImportOptions& options);

/// Adds --session-per-folder (folder_sessions.hpp): the tracked body or a clock may have been set up anew between folders.
/// Without it, sessions are found from the data.
void add_session_flag(console::Command command, bool& session_per_folder);

/// All of the above.
void add_import(console::Command command, ImportOptions& options);

/// Reads them, and says about each drive what was found and inferred. Throws console::WrongUsage, in words of the options, for
/// what importing::import_stated refuses of the statements, and what else it throws.
experiment::RunSet read_drive_files(const ImportOptions& options);

/// The same of the wheels alone: the runs have no truth.
experiment::RunSet read_wheel_files(const ImportOptions& options);

}  // namespace astro::commands
