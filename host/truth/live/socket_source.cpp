#include "host/truth/live/socket_source.hpp"

#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "host/base/error.hpp"
#include "host/base/system_error.hpp"
#include "host/base/text/numbers.hpp"

namespace astro::truth {
namespace {

constexpr std::string_view kGreeting = "astrolabe-mocap 1";

// The most that one call reads, so that a peer that sends faster than we read cannot block us; the next call
// reads the rest.
constexpr std::size_t kMostPending = std::size_t{1} << 20;
constexpr std::size_t kLongestLine = 1024;

Descriptor connect_to(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.size() >= sizeof(address.sun_path))
    throw Error("the path '" + text + "' is too long for a socket");
  std::strcpy(address.sun_path, text.c_str());
  Descriptor cameras(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!cameras || connect(cameras.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    throw system_error("no virtual cameras at '" + text + "'", errno, {}, SocketProblem::not_served, {text});
  return cameras;
}

template <class Number>
bool take(std::string_view& line, Number& number) {
  while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
  const auto taken = take_number<Number>(line);
  if (taken) number = *taken;
  return taken.has_value();
}

}  // namespace

SocketSource::SocketSource(const std::filesystem::path& path) : path_(path), socket_(connect_to(path)) {}

std::vector<recording::TruthSample> SocketSource::poll() {
  std::array<char, 16384> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  ssize_t count = -1;
  while (pending_.size() < kMostPending &&
         (count = recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0)
    pending_.append(bytes.data(), static_cast<std::size_t>(count));
  if (count == 0)
    throw Error("the simulator's cameras at '" + path_.string() + "' have disconnected: is it still running?",
                SocketProblem::disconnected, {path_.string()});

  std::vector<recording::TruthSample> samples;
  std::size_t start = 0;
  for (std::size_t end; (end = pending_.find('\n', start)) != std::string::npos; start = end + 1) {
    const std::string_view line(pending_.data() + start, end - start);
    if (greeted_) {
      samples.push_back(parse(line));
    } else if (line == kGreeting) {
      greeted_ = true;
    } else {
      throw Error("what answers at '" + path_.string() + "' is not this version's simulator",
                  SocketProblem::of_other_version, {path_.string()});
    }
  }
  pending_.erase(0, start);
  if (pending_.size() > kLongestLine) fail_line();
  return samples;
}

void SocketSource::fail_line() const {
  throw Error("the simulator's cameras at '" + path_.string() + "' sent a line that is no pose",
              SocketProblem::no_pose, {path_.string()});
}

recording::TruthSample SocketSource::parse(std::string_view line) const {
  recording::TruthSample sample;
  int valid = 0;
  if (!take(line, sample.time_us) || !take(line, sample.x_m) || !take(line, sample.y_m) ||
      !take(line, sample.theta_rad) || !take(line, valid))
    fail_line();
  sample.valid = valid != 0;
  return sample;
}

std::filesystem::path mocap_socket_of(const std::filesystem::path& port) {
  // The socket is beside the symlink that the simulator made, but `port` may be a symlink to that symlink.
  std::filesystem::path path = port;
  for (int hops = 0; hops < 8; ++hops) {
    const std::filesystem::path socket = path.string() + ".mocap";
    if (std::filesystem::exists(socket) || !std::filesystem::is_symlink(path)) return socket;
    const std::filesystem::path next = std::filesystem::read_symlink(path);
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return port.string() + ".mocap";
}

}  // namespace astro::truth
