#include "host/robot/sharing/background_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

namespace astro::robot {

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

}  // namespace astro::robot
