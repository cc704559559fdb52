#include "host/robot/sharing/relay_server.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <span>

#include "host/base/blocked_signals.hpp"
#include "host/base/error.hpp"
#include "host/base/system_error.hpp"
#include "host/robot/sharing/port_socket.hpp"

namespace astro::robot {

using std::chrono::milliseconds;

namespace {

constexpr microseconds kLineTimeout =
    milliseconds(1000);  // time after which a line that takes no bytes is lost
constexpr microseconds kFarewellTimeout =
    milliseconds(2000);  // for a program that does not read its Farewell
constexpr microseconds kStopTimeout =
    milliseconds(3000);  // for a robot that does not say that it stops for a driver that has gone
constexpr microseconds kDescriptorRetry = milliseconds(100);

microseconds steady_now() {
  return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
}

/// Writes as much as the descriptor takes; returns false if it is closed.
bool write_all(int descriptor, FrameQueue& queue, bool is_socket) {
  while (!queue.empty()) {
    const auto bytes = queue.front();
    const ssize_t count = is_socket ? ::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                                    : ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0) return errno == EAGAIN || errno == EINTR;
    queue.taken(static_cast<std::size_t>(count));
  }
  return true;
}

/// Leaves a process behind that goes on with what this one was doing. Forks twice, so that no process has to wait for
/// the one that stays. Call it while this process has one thread.
///
/// Returns true in the process that stays: in a session of its own, with the default signal handlers, and with no open
/// descriptors but `keep` and empty standard streams. Returns false in this process, also if it could not be done.
bool leave_process_behind(const char* name, std::span<const int> keep) {
  const pid_t child = ::fork();
  if (child > 0) ::waitpid(child, nullptr, 0);
  if (child != 0) return false;
  if (::fork() != 0) ::_exit(0);
  ::setsid();
  ::prctl(PR_SET_NAME, name);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
  ::signal(SIGPIPE, SIG_IGN);
  ::alarm(0);
  const int most = static_cast<int>(::sysconf(_SC_OPEN_MAX));
  for (int number = 0; number < std::min(most, 65'536); ++number)
    if (std::find(keep.begin(), keep.end(), number) == keep.end()) ::close(number);
  for (int number = 0; number < 3; ++number) ::open("/dev/null", O_RDWR);
  return true;
}

}  // namespace

RelayServer::RelayServer(SharedLine shared)
    : shared_(std::move(shared)), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!wake_) throw system_error("the port cannot be served", errno);
  constexpr std::array<std::uint8_t, 1> kEndOfWhateverCameBefore{0};
  relay_.to_robot().push(kEndOfWhateverCameBefore);
  start(&RelayServer::run);
}

/// Sends each program its Farewell without waiting, so a program gets only what its socket takes at once.
RelayServer::~RelayServer() {
  stop();
  if (lost_) return;
  relay_.close_all(FarewellReason::holder_ended);
  end_connections();
}

void RelayServer::start(void (RelayServer::*work)()) {
  stop_ = false;
  const BlockedSignals blocked;
  thread_ = std::thread(work, this);
}

void RelayServer::stop() {
  stop_ = true;
  ::eventfd_write(wake_.get(), 1);
  if (thread_.joinable()) thread_.join();
}

Descriptor RelayServer::connect_self() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0)
    throw system_error("the port cannot be served", errno);
  Descriptor ours(ends[0]);
  {
    const std::lock_guard lock(mutex_);
    own_end_ = -1;
    arriving_.emplace_back(ends[1]);
  }
  ::eventfd_write(wake_.get(), 1);
  return ours;
}

Remark RelayServer::why_ended() const {
  const int end = own_end_;
  const auto reason = end < 0 ? FarewellReason::line_lost : static_cast<FarewellReason>(end);
  return {std::string(fact(reason)), reason};
}

void RelayServer::run() {
  while (!stop_ && !(lost_ && connections_.empty())) turn();
}

int RelayServer::milliseconds_to_wait() const {
  constexpr int kPollPeriod_ms = 100;
  int wait = -1;
  const bool must_poll = line_blocked_since_ || accept_from_ > steady_now() ||
                         std::any_of(connections_.begin(), connections_.end(),
                                     [](auto& c) { return c.closing_since.has_value(); });
  if (must_poll) wait = kPollPeriod_ms;
  if (const auto tick = relay_.next_tick()) {
    const auto left = std::chrono::ceil<milliseconds>(*tick - steady_now()).count();
    const int until = static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
    wait = wait < 0 ? until : std::min(wait, until);
  }
  return wait;
}

void RelayServer::turn() {
  std::vector<pollfd> ready{{wake_.get(), POLLIN, 0}, {shared_.line.get(), POLLIN, 0}};
  if (!relay_.to_robot().empty()) ready[1].events |= POLLOUT;
  for (const Connection& connection : connections_) {
    const bool waits = !relay_.to_session(connection.session).empty();
    ready.push_back({connection.socket.get(), static_cast<short>(POLLIN | (waits ? POLLOUT : 0)), 0});
  }
  const bool listens = shared_.listener && steady_now() >= accept_from_;
  if (listens) ready.push_back({shared_.listener.get(), POLLIN, 0});
  if (::poll(ready.data(), ready.size(), milliseconds_to_wait()) < 0) return;

  if (ready[0].revents != 0) take_new_connections();
  for (std::size_t i = 2; i < ready.size() && i - 2 < connections_.size(); ++i)
    if (ready[i].revents != 0 && ready[i].fd == connections_[i - 2].socket.get())
      read_from(connections_[i - 2]);
  if (listens && ready.back().revents != 0) accept_guest();
  relay_.tick(steady_now());
  write_line();
  if (!lost_ && ready[1].revents != 0) read_line();
  write_line();  // frames that the answers allow to be sent
  end_connections();
}

void RelayServer::take_new_connections() {
  eventfd_t count = 0;
  ::eventfd_read(wake_.get(), &count);
  std::vector<Descriptor> fresh;
  {
    const std::lock_guard lock(mutex_);
    fresh.swap(arriving_);
  }
  for (Descriptor& socket : fresh) add(std::move(socket), describe_process(::getpid()), false);
}

void RelayServer::accept_guest() {
  Descriptor socket(::accept4(shared_.listener.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!socket) {
    if (errno == EMFILE || errno == ENFILE) accept_from_ = steady_now() + kDescriptorRetry;
    return;
  }
  if (auto user = peer_of(socket)) add(std::move(socket), std::move(*user), true);
}

void RelayServer::add(Descriptor socket, PortUser user, bool guest) {
  const SessionId session = relay_.join(std::move(user), guest);
  connections_.push_back({std::move(socket), session, guest, std::nullopt, false});
  if (guest) ++guests_;
}

void RelayServer::read_line() {
  std::array<std::uint8_t, 4096> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const ssize_t count = ::read(shared_.line.get(), bytes.data(), bytes.size());
  if (count > 0) return relay_.from_robot({bytes.data(), static_cast<std::size_t>(count)}, steady_now());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  lose_line();
}

void RelayServer::write_line() {
  if (lost_) return;
  FrameQueue& queue = relay_.to_robot();
  const std::size_t before = queue.bytes();
  if (!write_all(shared_.line.get(), queue, false)) return lose_line();
  if (queue.empty() || queue.bytes() != before) line_blocked_since_.reset();
  if (queue.empty()) return;
  if (!line_blocked_since_) line_blocked_since_ = steady_now();
  if (steady_now() - *line_blocked_since_ > kLineTimeout) lose_line();
}

void RelayServer::read_from(Connection& connection) {
  std::array<std::uint8_t, 4096> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const ssize_t count = ::recv(connection.socket.get(), bytes.data(), bytes.size(), 0);
  if (count > 0)
    return relay_.from_session(connection.session, {bytes.data(), static_cast<std::size_t>(count)},
                               steady_now());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  relay_.leave(connection.session);
  connection.session = 0;
}

bool RelayServer::write_to(Connection& connection) {
  if (connection.session == 0) return false;
  FrameQueue& queue = relay_.to_session(connection.session);
  const bool open = write_all(connection.socket.get(), queue, true);
  const auto why = relay_.closing(connection.session);
  if (open && !why) return true;
  if (why && !connection.guest) own_end_ = static_cast<int>(*why);
  if (why && !connection.closing_since) connection.closing_since = steady_now();
  // The connection is read until the program disconnects: the program may still stop the robot, and closing a socket with
  // unread bytes would discard the Farewell before the program has read it.
  if (open && queue.empty() && !connection.told) {
    connection.told = true;
    ::shutdown(connection.socket.get(), SHUT_WR);
  }
  if (open && steady_now() - *connection.closing_since <= kFarewellTimeout) return true;
  relay_.leave(connection.session);
  connection.session = 0;
  return false;
}

void RelayServer::end_connections() {
  for (Connection& connection : connections_) {
    if (!write_to(connection) && connection.guest) --guests_;
  }
  std::erase_if(connections_, [](const Connection& c) { return c.session == 0; });
}

void RelayServer::lose_line() {
  relay_.close_all(FarewellReason::line_lost);
  line_blocked_since_.reset();
  shared_.listener.reset();
  shared_.line.reset();  // so that the next program can open it again
  lost_ = true;
}

void RelayServer::serve_guests() {
  microseconds last_guest = steady_now();
  const auto owes_stop = [&] { return relay_.owes_stop() && steady_now() - last_guest < kStopTimeout; };
  while (!stop_ && !lost_ && (guests_ > 0 || owes_stop())) {
    turn();
    if (guests_ > 0) last_guest = steady_now();
  }
  if (!stop_ && !lost_) lose_line();
}

bool RelayServer::serve_others_only() {
  stop();
  if (lost_ || guests_ == 0) return false;
  start(&RelayServer::serve_guests);
  return true;
}

void RelayServer::leave_behind() {
  stop();
  if (lost_ || guests_ == 0) return;
  std::vector<int> keep{wake_.get(), shared_.line.get(), shared_.listener.get()};
  for (const Connection& connection : connections_) keep.push_back(connection.socket.get());
  if (!leave_process_behind("astrolabe-relay", keep)) return connections_.clear();
  constexpr int kBacklog = 16;
  if (shared_.listener)
    ::listen(shared_.listener.get(), kBacklog);  // again, so that SO_PEERCRED names this process
  stop_ = false;
  serve_guests();
  ::_exit(0);
}

}  // namespace astro::robot
