#include "host/commands/live/foxglove_options.hpp"

#include <fmt/format.h>

#include <boost/asio/ip/address.hpp>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/live/foxglove/origin.hpp"
#include "host/live/foxglove/server.hpp"

namespace astro::commands {
namespace {

bool is_loopback(const std::string& ip) { return ip.starts_with("127.") || ip == "::1"; }

/// The host part of a URL.
std::string host_of(const std::string& ip) {
  if (ip == "127.0.0.1") return "localhost";
  if (ip == "0.0.0.0" || ip == "::") return "THIS-COMPUTER";
  return ip.find(':') == std::string::npos ? ip : '[' + ip + ']';
}

std::string check_origin(const std::string& word) {
  if (foxglove::is_origin(word)) return "";
  return "'" + word +
         "' is no origin as a browser names it: scheme://host or scheme://host:port, without a path";
}

std::string check_address(const std::string& word) {
  try {
    foxglove_address_in(word);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

constexpr Advice kFoxgloveAdvice[] = {
    {foxglove::ServerProblem::port_taken, ": choose another port with --listen"},
    {foxglove::OriginProblem::refused, "; --allow-origin '{0}' allows it"},
};

}  // namespace

foxglove::Address foxglove_address_in(const std::string& word) {
  foxglove::Address address;
  const std::size_t colon = word.rfind(':');
  std::string_view digits(word);
  if (colon != std::string::npos) digits.remove_prefix(colon + 1);
  const auto port = take_number<std::uint16_t>(digits);
  if (!port || !digits.empty())
    throw Error("'" + word + "' is not PORT or ADDRESS:PORT, with a port up to 65535");
  address.port = *port;
  if (colon == std::string::npos) return address;
  std::string ip = word.substr(0, colon);
  if (ip == "localhost") return address;
  if (ip.starts_with('[') && ip.ends_with(']')) ip = ip.substr(1, ip.size() - 2);
  boost::system::error_code no_address;
  boost::asio::ip::make_address(ip, no_address);
  if (no_address)
    throw Error("'" + ip + "' is no address of a network, as 192.168.1.7, [::1] or 0.0.0.0 for all of them");
  address.ip = std::move(ip);
  return address;
}

void add_foxglove_options(console::Command command, FoxgloveOptions& options) {
  advise(kFoxgloveAdvice);
  const console::Option wanted = command.add_flag(
      "--foxglove", options.wanted, "serve viewers that speak the Foxglove\nWebSocket protocol");
  options.listening = command
                          .add_option("--listen", options.listen,
                                      "where viewers connect; without an address\nfrom this computer alone. "
                                      "--port with a bare\nnumber says the same")
                          .type_name("[ADDRESS:]PORT")
                          .capture_default_str()
                          .check(check_address)
                          .needs(wanted);
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

void take_viewers_port(std::string& port, FoxgloveOptions& options) {
  if (port.empty() || port.find_first_not_of("0123456789") != std::string::npos) return;
  if (options.listening.count() > 0)
    throw console::WrongUsage("--port " + port +
                              " and --listen both say where viewers connect: leave one out");
  if (const std::string wrong = check_address(port); !wrong.empty())
    throw console::WrongUsage("--port: " + wrong);
  options.listen = std::exchange(port, "");
}

std::string foxglove_announcement(const FoxgloveOptions& options, std::uint16_t port) {
  const std::string ip = foxglove_address_in(options.listen).ip;
  const std::string place = fmt::format("{}:{}", host_of(ip), port);
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
  settings.address = foxglove_address_in(options.listen);
  settings.origins = options.origins;
  settings.allow_commands = options.allow_commands;
  settings.always_served = {names.absolute("emergency_stop"), names.absolute("stop")};
  settings.notice = [](const Remark& remark) { console::say(in_words(remark)); };
  return settings;
}

}  // namespace astro::commands
