#include "tests/support/programs/traced_program.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

#include "tests/support/base/temporary_folder.hpp"

namespace astro::support {

#if defined(__x86_64__)

namespace {

using Words = std::vector<std::string>;

// What a call is about: the place of its path or descriptor among its arguments, and the error that it meets.
struct Kind {
  const char* name;
  int path = -1;        // argument that is a path
  int descriptor = -1;  // argument that is a descriptor
  bool writes = false;  // a buffer and its size follow the descriptor
  int error = EIO;
};

const std::map<long, Kind>& kinds() {
  static const std::map<long, Kind> all{{SYS_write, {"write", -1, 0, true, ENOSPC}},
                                        {SYS_pwrite64, {"write", -1, 0, true, ENOSPC}},
                                        {SYS_writev, {"write vector", -1, 0, false, ENOSPC}},
                                        {SYS_openat, {"open", 1, -1, false, EMFILE}},
                                        {SYS_open, {"open", 0, -1, false, EMFILE}},
                                        {SYS_rename, {"rename", 0, -1, false, EACCES}},
                                        {SYS_renameat, {"rename", 1, -1, false, EACCES}},
                                        {SYS_renameat2, {"rename", 1, -1, false, EACCES}},
                                        {SYS_link, {"link", 0, -1, false, EACCES}},
                                        {SYS_linkat, {"link", 1, -1, false, EACCES}},
                                        {SYS_unlink, {"remove", 0, -1, false, EACCES}},
                                        {SYS_unlinkat, {"remove", 1, -1, false, EACCES}},
                                        {SYS_mkdir, {"make folder", 0, -1, false, ENOSPC}},
                                        {SYS_mkdirat, {"make folder", 1, -1, false, ENOSPC}},
                                        {SYS_ftruncate, {"truncate", -1, 0, false, EIO}},
                                        {SYS_fsync, {"synchronise", -1, 0, false, EIO}},
                                        {SYS_fdatasync, {"synchronise", -1, 0, false, EIO}}};
  return all;
}

/// From now on the calls of kinds() stop this process for its tracer; all others run at full speed.
void stop_at_calls() {
  std::vector<sock_filter> filter{BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr))};
  for (const auto& [number, kind] : kinds()) {
    filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(number), 0, 1));
    filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRACE));
  }
  filter.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) _exit(126);
}

void redirect(const std::string& path, int flags, int to) {
  const int file = open(path.c_str(), flags, 0600);
  dup2(file, to);
  close(file);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Tracer {
 public:
  Tracer(const Words& command, std::string folder, Interference interference, const TraceHooks& hooks)
      : folder_(std::move(folder)), interference_(interference), hooks_(hooks) {
    start(command);
    hooks_.started(child_);
  }

  TracedOutcome run() {
    int status = 0;
    while (true) {
      // Its threads are in its process group, and other children of this process are not.
      const pid_t who = waitpid(-child_, &status, __WALL);
      if (who < 0) throw std::runtime_error("the traced program is lost");
      if (!WIFSTOPPED(status)) {
        if (who == child_) break;
        continue;  // a thread has ended
      }
      stopped(who, status);
    }
    outcome_.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome_.out = text_of(file("out"));
    outcome_.err = text_of(file("err"));
    return outcome_;
  }

 private:
  std::string file(const char* name) const { return (streams_.path() / name).string(); }

  void start(const Words& command) {
    std::array<int, 2> go{};
    if (pipe2(go.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    child_ = fork();
    if (child_ == 0) {
      setpgid(0, 0);
      redirect("/dev/null", O_RDONLY, 0);
      redirect(file("out"), O_WRONLY | O_CREAT | O_TRUNC, 1);
      redirect(file("err"), O_WRONLY | O_CREAT | O_TRUNC, 2);
      alarm(100);  // whatever is done to it, it ends; the timer survives exec
      char ready = 0;
      if (read(go[0], &ready, 1) != 1) _exit(125);
      stop_at_calls();
      execv(arguments[0], arguments.data());
      _exit(127);
    }
    setpgid(child_, child_);
    const long options = PTRACE_O_TRACESECCOMP | PTRACE_O_TRACECLONE | PTRACE_O_TRACEFORK |
                         PTRACE_O_TRACEVFORK | PTRACE_O_EXITKILL | PTRACE_O_TRACESYSGOOD;
    const bool traced = ptrace(PTRACE_SEIZE, child_, nullptr, options) == 0;
    if (traced && write(go[1], "g", 1) != 1) throw std::runtime_error("the child cannot be started");
    close(go[0]);
    close(go[1]);
    if (!traced) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
      throw std::runtime_error("this system lets nobody trace");
    }
  }

  void stopped(pid_t who, int status) {
    const int event = status >> 16;
    if (event == PTRACE_EVENT_SECCOMP) return at_call(who);
    const int signal = WSTOPSIG(status);
    if (signal == (SIGTRAP | 0x80)) {  // half of what was to be written has been
      kill(child_, SIGKILL);
      return;
    }
    ptrace(PTRACE_CONT, who, nullptr, event != 0 ? 0L : static_cast<long>(signal));
  }

  void at_call(pid_t who) {
    user_regs_struct registers{};
    ptrace(PTRACE_GETREGS, who, nullptr, &registers);
    const Kind& kind = kinds().at(static_cast<long>(registers.orig_rax));
    const std::string call = described(who, kind, registers);
    if (call.empty() || !hooks_.counts(call)) {
      ptrace(PTRACE_CONT, who, nullptr, 0L);
      return;
    }
    outcome_.calls.push_back(call);
    if (interference_.harm != Harm::none && outcome_.calls.size() == interference_.at)
      return harm(who, kind, registers);
    ptrace(PTRACE_CONT, who, nullptr, 0L);
  }

  void harm(pid_t who, const Kind& kind, user_regs_struct registers) {
    outcome_.was_hit = true;
    if (interference_.harm == Harm::fails) {
      registers.orig_rax = static_cast<unsigned long long>(-1);  // no call
      registers.rax = static_cast<unsigned long long>(-kind.error);
      ptrace(PTRACE_SETREGS, who, nullptr, &registers);
      ptrace(PTRACE_CONT, who, nullptr, 0L);
    } else if (interference_.harm == Harm::killed_amid && kind.writes && registers.rdx > 1) {
      registers.rdx /= 2;
      ptrace(PTRACE_SETREGS, who, nullptr, &registers);
      ptrace(PTRACE_SYSCALL, who, nullptr, 0L);
    } else {
      kill(child_, SIGKILL);
    }
  }

  /// What the call is about; "" if it does not count.
  std::string described(pid_t who, const Kind& kind, const user_regs_struct& registers) const {
    const std::array<unsigned long long, 3> arguments{registers.rdi, registers.rsi, registers.rdx};
    if (kind.path >= 0) {
      const auto at = static_cast<std::size_t>(kind.path);
      const std::string path = string_at(who, arguments[at]);
      if (std::string(kind.name) != "open") return std::string(kind.name) + " " + path;
      const bool changes = (arguments[at + 1] & (O_WRONLY | O_RDWR | O_CREAT)) != 0;
      if (path == "/dev/null" || (!changes && !path.starts_with(folder_))) return "";
      return (changes ? "open for writing " : "open ") + path;
    }
    if (arguments[0] == STDERR_FILENO) return "";
    const std::string path = path_of(who, arguments[0]);
    if (!path.starts_with('/') || path == "/dev/null") return "";
    const std::string size = kind.writes ? " " + std::to_string(arguments[2]) + " bytes to" : "";
    return std::string(kind.name) + size + " " + path;
  }

  static std::string string_at(pid_t who, unsigned long long address) {
    std::string text;
    while (text.size() < 4096) {
      std::array<char, 64> piece{};
      const std::size_t size =
          piece.size() - (address + text.size()) % piece.size();  // never over the end of a page
      iovec local{piece.data(), size}, remote{reinterpret_cast<void*>(address + text.size()), size};
      if (process_vm_readv(who, &local, 1, &remote, 1, 0) != static_cast<ssize_t>(size)) return text;
      const std::size_t length = strnlen(piece.data(), size);
      text.append(piece.data(), length);
      if (length < size) return text;
    }
    return text;
  }

  static std::string path_of(pid_t who, unsigned long long descriptor) {
    std::error_code none;
    const auto link = "/proc/" + std::to_string(who) + "/fd/" + std::to_string(static_cast<int>(descriptor));
    return std::filesystem::read_symlink(link, none).string();
  }

  test::TemporaryFolder streams_;
  std::string folder_;
  Interference interference_;
  const TraceHooks& hooks_;
  TracedOutcome outcome_;
  pid_t child_ = -1;
};

}  // namespace

bool can_trace() {
  static const bool can = [] {
    try {
      return run_traced({"/bin/true"}, "/nowhere", {}).code == 0;
    } catch (const std::exception&) {
      return false;
    }
  }();
  return can;
}

TracedOutcome run_traced(const Words& command, const std::string& folder, Interference interference,
                         const TraceHooks& hooks) {
  return Tracer(command, folder, interference, hooks).run();
}

#else  // registers have other names elsewhere

bool can_trace() { return false; }

TracedOutcome run_traced(const std::vector<std::string>&, const std::string&, Interference,
                         const TraceHooks&) {
  throw std::runtime_error("no tracing on this architecture");
}

#endif

}  // namespace astro::support
