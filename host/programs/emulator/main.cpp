#include <exception>
#include <filesystem>
#include <memory>
#include <new>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/served_robot_options.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/console/program.hpp"
#include "host/formats/files/firmware_image.hpp"
#include "host/programs/emulator/served_teensy.hpp"

namespace {

using namespace astro;  // NOLINT(google-build-using-namespace): a program's own file
namespace fs = std::filesystem;

void run(const fs::path& hex, commands::SimOptions& options) {
  commands::prepare(options, emulator::FlashChip::kParametersEnd - emulator::FlashChip::kParameters);
  if (const fs::path& usb = options.server.second_pty;
      !usb.empty() && fs::weakly_canonical(fs::absolute(usb).parent_path()) / usb.filename() ==
                          fs::weakly_canonical(fs::absolute(options.server.pty).parent_path()) /
                              options.server.pty.filename())
    throw Error("--usb-pty must be another path than --pty");
  simulation::Server server(
      std::make_unique<emulator::ServedTeensy>(hex, options.robot, options.mocap, options.server),
      options.server);
  if (!options.server.second_pty.empty())
    console::say("its USB port is at " + options.server.second_pty.string());
  commands::serve(server, "an emulated robot");
}

constexpr commands::Advice kImageAdvice[] = {
    {ImageProblem::unreadable, ": build one with './dev firmware'"},
    {ImageProblem::too_large, ": build one with './dev firmware'"},
    {ImageProblem::of_other_board, ": build one with './dev firmware'"}};

int run(int argc, char** argv) {
  commands::advise(kImageAdvice);
  console::Program program(
      "astrolabe-emulator",
      "Runs a robot's firmware image on an emulated Teensy 4.0 behind a pseudo terminal.");
  const console::Command app = program.command();
  fs::path hex;
  commands::SimOptions options;
  app.add_option("firmware", hex, "image for the Teensy 4.0, as './dev firmware' builds it")
      .type_name("HEX")
      .required();
  commands::add_sim_options(app, options);
  app.add_option("--usb-pty", options.server.second_pty,
                 "path to put the USB port at; --pty is the serial port")
      .type_name("PATH");
  console::examples(
      app,
      {"astrolabe-emulator build/teensy40/bin/astrolabe-teensy40.hex --pty /tmp/robot --fast",
       "astrolabe-emulator build/teensy40/bin/astrolabe-teensy40.hex --pty /tmp/robot --usb-pty /tmp/usb"});
  app.callback([&] { run(hex, options); });
  return program.run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  console::hold_standard_streams();
  console::watch_for_interrupt();
  try {
    return run(argc, argv);
  } catch (const std::filesystem::filesystem_error& error) {
    console::complain(console::in_words(error));
    return 1;
  } catch (const astro::Error& error) {
    console::complain(astro::commands::in_words(error));
    return 1;
  } catch (const std::bad_alloc&) {
    console::complain_without_memory(astro::commands::kNoMemory);
    return 1;
  } catch (const std::exception& error) {
    console::complain(error.what());
    return 1;
  }
}
