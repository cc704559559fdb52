#pragma once

#include "host/commands/shared/import_options.hpp"

/// Refuses options that would have no effect, because whoever gives one expects that it counts.
namespace astro::commands {

/// Throws console::WrongUsage naming an option that applies to none of the named files: one about tables of wheels without
/// tables, one about bags without bags. A missing file counts as any kind, because its reader gives a better error.
void refuse_unused_choices(const ImportOptions& options);

/// Throws console::WrongUsage, naming it, if an option about the files of drives is given. Precondition: no such files are
/// named.
void refuse_choices_without_drives(const ImportOptions& options);

}  // namespace astro::commands
