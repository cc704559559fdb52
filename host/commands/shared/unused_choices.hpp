#pragma once

#include "host/commands/shared/import_options.hpp"

/// Options that would have no effect are refused: whoever gives one expects that it counts.
namespace astro::commands {

/// Throws console::WrongUsage naming an option that applies to none of the named files: one about tables of wheels without
/// tables, one about bags without bags. Files that do not exist count as either, because their reader says so better.
void refuse_unused_choices(const ImportOptions& options);

/// Throws console::WrongUsage naming an option about the files of drives. Precondition: no such files are named.
void refuse_choices_without_drives(const ImportOptions& options);

}  // namespace astro::commands
