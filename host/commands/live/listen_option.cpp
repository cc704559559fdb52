#include "host/commands/live/listen_option.hpp"

#include <fmt/format.h>

#include <boost/asio/ip/address.hpp>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/wrong_usage.hpp"

namespace astro::commands {
namespace {

std::string check_address(const std::string& word) {
  try {
    listen_address_in(word);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

constexpr Advice kListenAdvice[] = {{web::ServerProblem::port_taken, ": choose another port with --listen"}};

}  // namespace

web::Address listen_address_in(const std::string& word) {
  web::Address address;
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

void add_listen(console::Command command, ListenOption& option, const std::string& help) {
  advise(kListenAdvice);
  option.listening = command.add_option("--listen", option.listen, help)
                         .type_name("[ADDRESS:]PORT")
                         .capture_default_str()
                         .check(check_address);
}

void take_listen_port(std::string& port, ListenOption& option) {
  if (port.empty() || port.find_first_not_of("0123456789") != std::string::npos) return;
  if (option.listening.count() > 0)
    throw console::WrongUsage("--port " + port +
                              " and --listen both say where viewers connect: leave one out");
  if (const std::string wrong = check_address(port); !wrong.empty())
    throw console::WrongUsage("--port: " + wrong);
  option.listen = std::exchange(port, "");
}

bool is_loopback(const std::string& ip) { return ip.starts_with("127.") || ip == "::1"; }

std::string place_in_url(const std::string& ip, std::uint16_t port) {
  const std::string host = ip == "127.0.0.1"               ? "localhost"
                           : ip == "0.0.0.0" || ip == "::" ? "THIS-COMPUTER"
                           : ip.find(':') == ip.npos       ? ip
                                                           : '[' + ip + ']';
  return fmt::format("{}:{}", host, port);
}

}  // namespace astro::commands
