#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>

#include "common/base/version.hpp"
#include "host/base/error.hpp"
#include "host/cli/command.hpp"
#include "host/cli/console.hpp"
#include "host/cli/interrupt.hpp"
#include "host/link/drive.hpp"

namespace {

constexpr int kFailed = 1, kWrongUsage = 2, kInterrupted = 130;

void add_commands(CLI::App& app) {
  using namespace astro::cli;
  for (const auto add : {add_umbmark, add_calibrate, add_upload, add_record, add_compare, add_report, add_sim,
                         add_ports, add_info, add_params, add_drive, add_stop, add_faults, add_reboot})
    add(app);
}

// CLI11 says "The following argument was not expected: foo"; a person typed a word and wants to know about
// that word.
std::string sentence_for(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const bool first_is_word = argc > 1 && argv[1][0] != '-';
  if (first_is_word) {
    const auto known = app.get_subcommands([&](const CLI::App* sub) { return sub->get_name() == argv[1]; });
    if (known.empty())
      return fmt::format("there is no subcommand '{}'; 'astrolabe --help' lists them", argv[1]);
    return fmt::format("{} ('astrolabe {} --help' explains)", error.what(), argv[1]);
  }
  return fmt::format("{} ('astrolabe --help' explains)", error.what());
}

int run(int argc, char** argv) {
  CLI::App app("Calibrates the odometry of differential-drive robots.", "astrolabe");
  app.require_subcommand(1);
  app.set_version_flag("--version",
                       fmt::format("astrolabe {}.{}.{}", astro::kFirmwareVersion.major,
                                   astro::kFirmwareVersion.minor, astro::kFirmwareVersion.patch));
  app.footer("'astrolabe COMMAND --help' shows options and examples.");
  add_commands(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wish) {
    return app.exit(wish);  // --help, --version
  } catch (const CLI::ParseError& error) {
    astro::cli::complain(sentence_for(app, error, argc, argv));
    return kWrongUsage;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  astro::cli::watch_for_interrupt();
  try {
    return run(argc, argv);
  } catch (const astro::link::Interrupted& error) {
    astro::cli::complain(error.what());
    return kInterrupted;
  } catch (const astro::Error& error) {
    if (astro::cli::interrupted()) return kInterrupted;
    astro::cli::complain(error.what());
    return kFailed;
  } catch (const std::exception& error) {
    astro::cli::complain(std::string("this should not have happened, please report it: ") + error.what());
    return kFailed;
  }
}
