#include "host/robot/port/serial_port.hpp"

// termios2 allows any baud rate. It is in the kernel's headers; glibc's <termios.h> cannot be included beside
// them.
#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "host/base/error.hpp"
#include "host/base/system_error.hpp"
#include "host/robot/port/ports.hpp"

namespace astro::robot {

namespace {

std::string ports_here() {
  std::string list;
  for (const Port& port : candidate_ports()) list += (list.empty() ? "" : ", ") + port.address;
  return list.empty() ? "no serial port and no simulator is here" : "here are " + list;
}

bool is_link(const std::string& path) {
  struct stat about {};
  return ::lstat(path.c_str(), &about) == 0 && S_ISLNK(about.st_mode);
}

Remark why_not_open(const std::string& path, int error) {
  constexpr const char* kNothingBehind =
      " has nothing behind it: the device was unplugged or its simulator has ended";
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      if (is_link(path)) return {path + kNothingBehind};
      return {"there is no port " + path + "; " + ports_here(), PortProblem::absent, {path}};
    case EACCES:
    case EPERM:
      return {"no permission to open " + path +
                  ": add yourself to its group (sudo usermod -aG dialout $USER), then log in again",
              PortProblem::no_permission,
              {path}};
    case ELOOP:
      return {path + " is a link that leads back to itself; " + ports_here() + ": name the port itself"};
    case EISDIR:
      return {path + " is a folder, not a serial port", PortProblem::is_folder, {path}};
    case EIO:
    case ENXIO:
    case ENODEV:
      return {path + kNothingBehind};
    default:
      return {"cannot open " + path + ": " + system_reason(error)};
  }
}

// 8N1, no flow control, every byte unchanged. VMIN is 1 so that a read without data does not look like a
// hang-up.
void make_raw(termios2& mode, unsigned baud) {
  mode.c_iflag = IGNBRK | IGNPAR;
  mode.c_oflag = 0;
  mode.c_lflag = 0;
  mode.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (mode.c_cflag & HUPCL);
  mode.c_ispeed = 0;  // 0: the same as the output speed
  mode.c_ospeed = baud;
  mode.c_cc[VMIN] = 1;
  mode.c_cc[VTIME] = 0;
}

}  // namespace

std::string port_key(const struct stat& about) {
  // Each container numbers its ptys from 0, in a file system of its own.
  constexpr unsigned kFirstPty = 136, kLastPty = 143;
  const unsigned kind = major(about.st_rdev);
  const bool is_pty = kind >= kFirstPty && kind <= kLastPty;
  return (is_pty ? "pty-" + std::to_string(about.st_dev) : "port") + "-" + std::to_string(kind) + "-" +
         std::to_string(minor(about.st_rdev));
}

std::string port_key_of(int descriptor) {
  struct stat about {};
  ::fstat(descriptor, &about);
  return port_key(about);
}

Descriptor open_serial_port(const std::string& path, unsigned baud) {
  Descriptor port(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!port) throw Error(why_not_open(path, errno));
  termios2 mode{};
  if (::ioctl(port.get(), TCGETS2, &mode) != 0)
    throw Error(path + " is not a serial port", PortProblem::not_serial, {path});
  struct stat about {};
  if (::fstat(port.get(), &about) == 0) {
    if (const auto user = terminal_user(about.st_rdev)) {
      throw Error(path + " is not a robot but the terminal that '" + *user + "' runs in",
                  PortProblem::is_terminal, {path});
    }
  }
  if (::flock(port.get(), LOCK_EX | LOCK_NB) != 0)
    throw PortInUse(path + " is in use by another program, which does not share it", path, port_key(about));
  make_raw(mode, baud);
  if (::ioctl(port.get(), TCSETS2, &mode) != 0) {
    if (errno == EIO) throw Error(why_not_open(path, EIO));
    throw Error(path + " cannot be set to " + std::to_string(baud) + " baud: " + std::strerror(errno));
  }
  return port;
}

}  // namespace astro::robot
