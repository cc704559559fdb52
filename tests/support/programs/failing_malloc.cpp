// Preloaded into a program (LD_PRELOAD): lists the places that allocate memory, or lets one of them fail.
//
//   ASTRO_MALLOC_LIST=FILE    appends one line for each place, in the order of the first use
//   ASTRO_MALLOC_FAIL=PLACE   the first allocation at this place returns no memory, all others do
//   ASTRO_MALLOC_HIT=FILE     is made when that happens
//
// A place is the innermost frames of the call stack, relative to their modules. Counting allocations would be
// simpler, but a program that talks to a robot does not make the same number of them twice. Only what main
// does counts: before it and after it no program can say anything.
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
}

namespace {

constexpr int kOwnFrames = 2, kFrames = 9;

std::atomic<bool> watching = false, has_failed = false;
thread_local bool inside = false;
const char* list_file = nullptr;
const char* hit_file = nullptr;
std::uint64_t to_fail = 0;
std::array<std::atomic<std::uint64_t>, 1U << 17> seen;

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9E37'79B9'7F4A'7C15ULL + (hash << 6U) + (hash >> 2U);
  return hash * 0xFF51'AFD7'ED55'8CCDULL;
}

std::uint64_t place() {
  std::array<void*, kOwnFrames + kFrames> frames{};
  const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
  std::uint64_t hash = 1;
  for (int i = kOwnFrames; i < count; ++i) {
    dl_find_object object{};
    const auto address = reinterpret_cast<std::uintptr_t>(frames[static_cast<std::size_t>(i)]);
    const bool is_known = _dl_find_object(frames[static_cast<std::size_t>(i)], &object) == 0;
    hash = mixed(hash, address - (is_known ? reinterpret_cast<std::uintptr_t>(object.dlfo_map_start) : 0));
  }
  return hash == 0 ? 1 : hash;
}

void append(const char* file, const char* text, std::size_t size) {
  const int descriptor = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (descriptor < 0) return;
  if (write(descriptor, text, size) < 0) std::abort();
  close(descriptor);
}

bool is_new(std::uint64_t hash) {
  for (std::size_t i = 0; i < seen.size(); ++i) {
    std::uint64_t expected = 0;
    std::atomic<std::uint64_t>& slot = seen[(hash + i) % seen.size()];
    if (slot.compare_exchange_strong(expected, hash)) return true;
    if (expected == hash) return false;
  }
  return false;
}

void list(std::uint64_t hash) {
  std::array<char, 17> line{};
  for (std::size_t i = 0; i < 16; ++i) line[i] = "0123456789abcdef"[(hash >> (60 - 4 * i)) & 15U];
  line[16] = '\n';
  append(list_file, line.data(), line.size());
}

/// True if this allocation is the one to fail.
bool fails() {
  if (!watching || inside) return false;
  inside = true;
  const int saved = errno;
  const std::uint64_t hash = place();
  if (list_file != nullptr && is_new(hash)) list(hash);
  const bool hit = to_fail != 0 && hash == to_fail && !has_failed.exchange(true);
  if (hit && hit_file != nullptr) append(hit_file, "hit\n", 4);
  errno = hit ? ENOMEM : saved;
  inside = false;
  return hit;
}

int (*real_main)(int, char**, char**) = nullptr;

int watched_main(int count, char** arguments, char** environment) {
  std::array<void*, 4> warm_up{};
  backtrace(warm_up.data(), static_cast<int>(warm_up.size()));  // its first call allocates
  watching = true;
  const int code = real_main(count, arguments, environment);
  watching = false;
  return code;
}

__attribute__((constructor)) void read_environment() {
  list_file = std::getenv("ASTRO_MALLOC_LIST");
  hit_file = std::getenv("ASTRO_MALLOC_HIT");
  if (const char* const place_text = std::getenv("ASTRO_MALLOC_FAIL"))
    to_fail = std::strtoull(place_text, nullptr, 16);
}

}  // namespace

extern "C" {

__attribute__((visibility("default"), noinline)) void* malloc(std::size_t size) {
  return fails() ? nullptr : __libc_malloc(size);
}

__attribute__((visibility("default"), noinline)) void* calloc(std::size_t count, std::size_t size) {
  return fails() ? nullptr : __libc_calloc(count, size);
}

__attribute__((visibility("default"), noinline)) void* realloc(void* old, std::size_t size) {
  return fails() ? nullptr : __libc_realloc(old, size);
}

int __libc_start_main(int (*main)(int, char**, char**), int count, char** arguments, void (*init)(),
                      void (*fini)(), void (*loader_fini)(), void* stack_end);
__attribute__((visibility("default"))) int __libc_start_main(int (*main)(int, char**, char**), int count,
                                                             char** arguments, void (*init)(), void (*fini)(),
                                                             void (*loader_fini)(), void* stack_end) {
  using Start = int (*)(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  real_main = main;
  return start(watched_main, count, arguments, init, fini, loader_fini, stack_end);
}
}
