#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "common/base/version.hpp"
#include "host/base/error.hpp"
#include "host/base/interrupted.hpp"
#include "host/base/system_error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/program.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/programs/astrolabe/about.hpp"
#include "host/programs/astrolabe/all_commands.hpp"
#include "host/programs/astrolabe/demo.hpp"
#include "host/programs/astrolabe/help.hpp"

namespace {

using namespace astro::commands;  // NOLINT(google-build-using-namespace): this file is all commands
using namespace astro::console;   // NOLINT(google-build-using-namespace): and how they meet the terminal

constexpr int kFailed = 1, kWrongUsage = 2, kInterrupted = 130;

int run(int argc, char** argv);

int run_words(const std::vector<std::string>& words) {
  std::vector<std::string> line{"astrolabe"};
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : line) pointers.push_back(word.data());
  return run(static_cast<int>(pointers.size()), pointers.data());
}

int run(int argc, char** argv) {
  Program program("astrolabe", "Calibrates the odometry of differential-drive robots.");
  const std::string version = fmt::format("astrolabe {}.{}.{}", astro::kFirmwareVersion.major,
                                          astro::kFirmwareVersion.minor, astro::kFirmwareVersion.patch);
  program.version(version);
  program.foreign_words(kRosArguments, "--");
  const Command app = program.command();
  app.require_subcommand(1, 1);
  app.footer(
      "'astrolabe COMMAND --help' shows options, 'astrolabe help' lists the guides.\n"
      "Exit codes:\n"
      "  0    done; also what runs until Ctrl-C, and what cannot be judged\n"
      "  1    something outside is wrong\n"
      "  2    wrong usage\n"
      "  3    a calibration is not better than what the robot carries\n"
      "  130  Ctrl-C before it was done");
  app.under("Start", [&] { add_demo(app, run_words); });
  add_all(app);
  add_about(app, version);
  add_help(app, run_words);
  const int code = program.run(argc, argv);
  flush_output();
  return code;
}

/// For a thread, a descriptor or a socket of a library that the system refuses.
std::string refused_by_system(const std::system_error& error) {
  return "the system refuses what this program needs: " + astro::system_reason(error.code().value());
}

/// The terminate handler, for exceptions at places that they must not leave, for example inside the standard
/// library's folder iterator. It prints the same as main() would, and leaves no core file. An armed robot
/// stops by its own time-out.
[[noreturn]] void report_and_terminate() {
  try {
    if (const std::exception_ptr why = std::current_exception()) std::rethrow_exception(why);
    std::fputs("astrolabe: this should not have happened, please report it: it ended itself\n", stderr);
  } catch (const std::bad_alloc&) {
    complain_without_memory(kNoMemory);
  } catch (const std::system_error& error) {
    complain(refused_by_system(error));
  } catch (const std::exception& error) {
    complain(std::string("this should not have happened, please report it: ") + error.what());
  } catch (...) {
    std::fputs("astrolabe: this should not have happened, please report it\n", stderr);
  }
  std::_Exit(kFailed);
}

/// Turns every exception into one sentence and an exit code.
int run_and_report(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const astro::Interrupted& error) {
    complain(in_words(error));
    return kInterrupted;
  } catch (const WrongUsage& error) {
    complain(error.what());
    return kWrongUsage;
  } catch (const astro::Error& error) {
    complain(in_words(error));  // also after Ctrl-C: the disk may be full, or the robot may not have stopped
    return kFailed;
  } catch (const std::filesystem::filesystem_error& error) {
    complain(in_words(error));
    return kFailed;
  } catch (const std::system_error& error) {
    complain(refused_by_system(error));
    return kFailed;
  } catch (const std::bad_alloc&) {
    complain_without_memory(kNoMemory);
    return kFailed;
  } catch (const std::exception& error) {
    complain(std::string("this should not have happened, please report it: ") + error.what());
    return kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::set_terminate(report_and_terminate);
  hold_standard_streams();
  watch_for_interrupt();
  const int code = run_and_report(argc, argv);
  leave_ports_to_others();  // whatever ended the command
  return code;
}
