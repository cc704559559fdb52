#include "host/page/wasm/page_port.hpp"

#include <chrono>
#include <utility>

namespace astro::page {
namespace {

using emscripten::val;
using std::chrono::milliseconds;

/// Operating systems need up to a second for it.
constexpr milliseconds kOpening(2000);
constexpr milliseconds kBetweenTries(50);

val serial() { return val::module_property("serial"); }
double in_ms(microseconds time) { return 1e-3 * static_cast<double>(time.count()); }
val view(std::span<const std::uint8_t> bytes) {
  return val(emscripten::typed_memory_view(bytes.size(), bytes.data()));
}

}  // namespace

PagePort::PagePort(std::string name) : name_(std::move(name)), line_(serial()) {
  if (line_.isUndefined()) throw Error("this page reaches no port: open a simulated robot");
  if (const std::string why = why_not_opened(); !why.empty()) throw Error(name_ + " " + why, {}, {name_});
}

PagePort::~PagePort() { line_.call<void>("close"); }

void PagePort::write(std::span<const std::uint8_t> bytes) { line_.call<void>("write", view(bytes)); }

std::size_t PagePort::read(std::span<std::uint8_t> into, microseconds timeout) {
  const int count = line_.call<int>("read", view(into), in_ms(timeout));
  if (count < 0) lose();
  return static_cast<std::size_t>(count);
}

microseconds PagePort::now() const {
  return std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch());
}

void PagePort::reopen(microseconds timeout) {
  const microseconds deadline = now() + timeout;
  while (true) {
    const std::string why = why_not_opened();
    if (why.empty()) return;
    if (now() >= deadline) throw Error(name_ + " " + why, {}, {name_});
    line_.call<void>("pause", in_ms(kBetweenTries));
  }
}

std::string PagePort::why_not_opened() { return line_.call<std::string>("open", name_, in_ms(kOpening)); }

void PagePort::lose() const {
  throw robot::LinkLost("lost " + name_ + ": it " + line_.call<std::string>("why_closed"));
}

void PagePort::take_questions() {
  if (const val line = serial(); !line.isUndefined()) line.call<void>("meanwhile");
}

}  // namespace astro::page
