#pragma once

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

/// What a piece of work takes at most, measured in a child process of its own.
namespace astro::support {

#ifdef ASTRO_SANITIZE
inline constexpr bool kMeasuresMemory =
    false;  // the sanitizer's own memory would count, and it reserves terabytes
#else
inline constexpr bool kMeasuresMemory = true;
#endif

struct Taken {
  std::string complaint;       // what the work threw; "" if nothing
  bool ended = false;          // by itself, not by a signal, and no expectation failed in it
  std::size_t peak_bytes = 0;  // of memory, beyond what the process had at the start
  double cpu_s = 0;            // as on a quiet machine
};

/// How many times longer work takes now than on a quiet machine, at least 1: processors that share a core, caches and memory with
/// other work are slower than alone, in processor seconds, too. It reads a million numbers from text into new memory.
inline double slowness() {
  constexpr double kQuiet_s = 0.030;  // of the machine that the limits were set on
  std::string text;
  for (int i = 0; i < 1000; ++i) text += std::to_string(i * 0.37) + ",";
  const auto cpu_s = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start_s = cpu_s();
  std::vector<double> numbers;
  for (int round = 0; round < 1000; ++round)
    for (const char* at = text.data(); at != text.data() + text.size();) {
      const auto read = std::from_chars(at, text.data() + text.size(), numbers.emplace_back());
      at = read.ptr + 1;
    }
  return std::max(1.0, (cpu_s() - start_s) / kQuiet_s);
}

/// Runs `work` in a copy of this process whose address space may grow by 1 GiB, so that work without a bound
/// ends in std::bad_alloc and not in the machine's swap; ends it after 60 s. Prints the figures.
template <class Work>
Taken measured_once(Work work) {
  const double slow_before = slowness();
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    const bool failed_before = testing::Test::HasFailure();
    close(ends[0]);
    alarm(60);
    // As in a program that has just started: after large blocks were freed, the allocator keeps the next ones.
    mallopt(M_MMAP_THRESHOLD, 128 * 1024);
    mallopt(M_TRIM_THRESHOLD, 128 * 1024);
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // the highest memory is that of now
    std::size_t pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const rlimit limit{pages * page + (std::size_t{1} << 30), RLIM_INFINITY};
    if (kMeasuresMemory) setrlimit(RLIMIT_AS, &limit);
    std::string complaint;
    try {
      work();
    } catch (const std::exception& error) {
      complaint = error.what();
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const std::size_t before = resident * page, most = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
    const std::string text = std::to_string(most - std::min(most, before)) + " " + complaint.substr(0, 4000);
    const ssize_t written = write(ends[1], text.data(), text.size());
    // An expectation of this process that failed is not one of the parent's, so it must not end well.
    const bool failed = !failed_before && testing::Test::HasFailure();
    _exit(written == static_cast<ssize_t>(text.size()) && !failed ? 0 : 1);
  }
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t count = 0; (count = read(ends[0], buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  Taken taken;
  taken.ended = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (const std::size_t blank = text.find(' '); taken.ended && blank != std::string::npos) {
    taken.peak_bytes = std::stoull(text);
    taken.complaint = text.substr(blank + 1);
  }
  const double slow = std::min(slow_before, slowness());
  taken.cpu_s = (static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                 1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec)) /
                slow;
  std::cout << "  " << taken.peak_bytes / 1048576 << " MiB, " << taken.cpu_s << " s on a machine " << slow
            << " times slower than quiet: " << taken.complaint.substr(0, 300) << '\n';
  return taken;
}

/// The same. Work that took longer than `most_s` is done again up to four times, and the least time counts: a machine that is busy
/// with something else only adds to it.
template <class Work>
Taken measured(Work work, double most_s = 1) {
  Taken taken = measured_once(work);
  for (int i = 0; i < 4 && taken.cpu_s > most_s; ++i)
    taken.cpu_s = std::min(taken.cpu_s, measured_once(work).cpu_s);
  return taken;
}

/// `text` again and again until it has at least so many bytes.
inline std::string filled(const std::string& text, std::size_t size) {
  std::string all = text;
  all.reserve(size + text.size());
  while (all.size() < size)
    all.append(all, 0, (size - all.size() + text.size() - 1) / text.size() * text.size());
  return all;
}

/// The bar for whatever comes from outside: four times its size and 64 MiB of memory, a second of work.
#define EXPECT_BOUNDED(taken, size)                                      \
  EXPECT_TRUE((taken).ended);                                            \
  if (astro::support::kMeasuresMemory) {                                 \
    EXPECT_LE((taken).peak_bytes, 4 * (size) + (std::size_t{64} << 20)); \
    EXPECT_LE((taken).cpu_s, 1.0);                                       \
  }                                                                      \
  static_assert(true)

}  // namespace astro::support
