#pragma once

#include "host/commands/shared/import_options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/import/drives/unused_choice.hpp"

/// Refuses options that would have no effect, in the names of the options.
namespace astro::commands {

/// The same as a person typed it: "--body does not apply here: ...".
console::WrongUsage wrong_usage(const importing::UnusedChoice& unused);

/// Throws that for what importing::refuse_unused_choices refuses.
void refuse_unused_choices(const ImportOptions& options);

/// Throws console::WrongUsage, naming it, if an option about the files of drives is given. Precondition: no such files are
/// named.
void refuse_choices_without_drives(const ImportOptions& options);

}  // namespace astro::commands
