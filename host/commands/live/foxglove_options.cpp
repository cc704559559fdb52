#include "host/commands/live/foxglove_options.hpp"

#include <fmt/format.h>

#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"
#include "host/live/foxglove/origin.hpp"

namespace astro::commands {
namespace {

std::string check_origin(const std::string& word) {
  if (foxglove::is_origin(word)) return "";
  return "'" + word +
         "' is no origin as a browser names it: scheme://host or scheme://host:port, without a path";
}

constexpr Advice kFoxgloveAdvice[] = {
    {foxglove::OriginProblem::refused, "; --allow-origin '{0}' allows it"},
};

}  // namespace

void add_foxglove_options(console::Command command, FoxgloveOptions& options) {
  advise(kFoxgloveAdvice);
  const console::Option wanted = command.add_flag(
      "--foxglove", options.wanted, "serve viewers that speak the Foxglove\nWebSocket protocol");
  add_listen(
      command, options,
      "where viewers connect; without an address\nfrom this computer alone. --port with a bare\nnumber "
      "says the same");
  options.listening.needs(wanted);
  command
      .add_option(
          "--allow-origin", options.origins,
          "web pages that may connect, beside Foxglove's\nown and those of this computer; may be repeated")
      .type_name("SCHEME://HOST[:PORT]")
      .one_each_time()
      .check(check_origin)
      .needs(wanted);
  command
      .add_flag("--allow-commands", options.allow_commands,
                "viewers may arm and drive the robot and set\nits parameters; otherwise they look, and "
                "can\nstop it")
      .needs(wanted);
}

std::string foxglove_announcement(const FoxgloveOptions& options, std::uint16_t port) {
  const std::string ip = listen_address_in(options.listen).ip;
  const std::string place = place_in_url(ip, port);
  std::string text = fmt::format(
      "viewers: ws://{0} in Foxglove, or https://app.foxglove.dev/?ds=foxglove-websocket&ds.url=ws://{0}",
      place);
  if (!is_loopback(ip))
    text += fmt::format("\nWARNING: other computers can connect, without a password; whoever does can {}",
                        options.allow_commands ? "DRIVE THE ROBOT" : "see and stop the robot");
  else if (options.allow_commands)
    text += "\nviewers may arm and drive the robot";
  return text;
}

foxglove::Settings foxglove_settings(const FoxgloveOptions& options, const std::string& name,
                                     const live::Names& names) {
  foxglove::Settings settings;
  settings.name = name;
  settings.address = listen_address_in(options.listen);
  settings.origins = options.origins;
  settings.allow_commands = options.allow_commands;
  settings.always_served = {names.absolute("emergency_stop"), names.absolute("stop")};
  settings.notice = [](const Remark& remark) { console::say(in_words(remark)); };
  return settings;
}

}  // namespace astro::commands
