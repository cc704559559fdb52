#include "host/robot/port/open_transport.hpp"

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "host/base/text/numbers.hpp"
#include "host/robot/port/serial_port.hpp"
#include "host/robot/port/stream_transport.hpp"

namespace astro::robot {

namespace asio = boost::asio;
using boost::system::error_code;

namespace {

asio::ip::tcp::endpoint parse_tcp(const std::string& address) {
  const Error bad("'" + address + "' is not an address of the form tcp:HOST:PORT, such as tcp:localhost:5555",
                  PortProblem::no_address, {address});
  const std::string rest = address.substr(4);
  const auto colon = rest.rfind(':');
  if (colon == std::string::npos) throw bad;
  std::string host = rest.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  const auto port = unsigned_in(std::string_view(rest).substr(colon + 1));
  if (!port || *port == 0 || *port > 0xFFFF || host.empty()) throw bad;
  if (host == "localhost") host = "127.0.0.1";
  error_code no_number;
  const auto ip = asio::ip::make_address(host, no_number);
  if (no_number || !ip.is_loopback()) {
    throw Error(
        address + " is not on this machine: a robot's link has no protection, so only localhost is allowed",
        PortProblem::not_local, {address});
  }
  return {ip, static_cast<std::uint16_t>(*port)};
}

asio::ip::tcp::socket connect_tcp(asio::io_context& context, const std::string& address,
                                  const asio::ip::tcp::endpoint& endpoint) {
  asio::ip::tcp::socket socket(context);
  error_code error;
  socket.connect(endpoint, error);
  if (error)
    throw Error("nothing listens at " + address + " (" + error.message() + "): is the simulator running?",
                PortProblem::nobody_listens, {address});
  socket.set_option(asio::ip::tcp::no_delay(true));
  socket.non_blocking(true);
  return socket;
}

}  // namespace

Descriptor open_line(const std::string& address, unsigned baud) {
  if (!address.starts_with("tcp:")) return open_serial_port(address, baud);
  asio::io_context context;
  return Descriptor(connect_tcp(context, address, parse_tcp(address)).release());
}

std::string tcp_key(const std::string& address) {
  const auto endpoint = parse_tcp(address);
  return "port-tcp-" + endpoint.address().to_string() + "-" + std::to_string(endpoint.port());
}

std::unique_ptr<Transport> open_transport(const std::string& address, unsigned baud) {
  if (address.empty()) throw Error("no port is named", PortProblem::none_named);
  if (address.starts_with("tcp:")) {
    const auto endpoint = parse_tcp(address);
    return std::make_unique<StreamTransport<asio::ip::tcp::socket>>(
        address, [=](asio::io_context& context) { return connect_tcp(context, address, endpoint); });
  }
  using StreamDescriptor = asio::posix::stream_descriptor;
  return std::make_unique<StreamTransport<StreamDescriptor>>(address, [=](asio::io_context& context) {
    Descriptor port = open_serial_port(address, baud);
    StreamDescriptor stream(context, port.get());
    port.release();
    stream.non_blocking(true);
    return stream;
  });
}

}  // namespace astro::robot
