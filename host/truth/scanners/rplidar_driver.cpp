#include "host/truth/scanners/rplidar_driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "host/base/error.hpp"

namespace astro::truth::rplidar {
namespace {

using namespace std::chrono_literals;
using std::chrono::microseconds;

constexpr std::array<unsigned, 3> kSpeeds{115'200, 256'000, 460'800};  // A1 and early A2; later A2 and A3; C1
constexpr microseconds kAnswer = 500ms;                                // the longest that an answer takes
constexpr microseconds kRestart = 1500ms;                              // from a reset to the first answer
constexpr microseconds kQuiet = 30ms, kLongestFlood = 500ms;
constexpr microseconds kSilence = 3s, kDamageWindow = 1s;
constexpr double kMostDamage = 0.5;

constexpr std::uint16_t kUsualSample_us = 476;  // of the models that cannot say it
constexpr std::uint16_t kMotorPwm = 660;        // at which an A2 turns ten times a second
constexpr double kBitsPerByte = 10;

int series_of(const Info& info) { return info.model >> 4; }
bool has_motor_pwm(const Info& info) { return series_of(info) == 2 || series_of(info) == 3; }

/// Data sheets: A1 0.15 to 12 m, C1 0.05 to 12 m, A3 up to 25 m. Later models of the A2 see farther than the 12 m that they have
/// in common.
TurnAssembler::Range range_of(const Info& info) {
  constexpr int kA3 = 3, kC1 = 4;
  return {series_of(info) == kC1 ? 0.05 : 0.15, series_of(info) == kA3 ? 25.0 : 12.0};
}

std::string speeds() { return "115200, 256000 and 460800"; }

/// From the middle of a measurement to its last byte: the maker's programs count one and a half measurements, and the line's time.
double delay_s(double sample_s, AnswerType type, unsigned baud) {
  const double bytes = static_cast<double>(type == AnswerType::nodes ? kNodeBytes : kCapsuleBytes);
  return 1.5 * sample_s + bytes * kBitsPerByte / baud;
}

}  // namespace

Driver::Driver(std::unique_ptr<Line> line) : line_(std::move(line)) {
  find_speed();
  require_health();
  line_->run_motor(true);
  start_scan();
}

Driver::~Driver() {
  try {
    send(Command::stop);
    if (has_motor_pwm(info_)) send(Command::set_motor_pwm, std::array<std::uint8_t, 2>{});
    line_->run_motor(false);
  } catch (const Error&) {  // the scanner is gone, and a destructor cannot say so
  }
}

void Driver::fail(ScannerProblem problem, const std::string& sentence, const std::string& value) const {
  std::vector<std::string> values{line_->name()};
  if (!value.empty()) values.push_back(value);
  throw Error(sentence, problem, std::move(values));
}

void Driver::find_speed() {
  for (const unsigned baud : kSpeeds)
    if (answers_at(baud)) return;
  if (!heard_)
    fail(ScannerProblem::silent,
         fmt::format("no laser scanner answers at {}, at {} baud: is it an RPLIDAR, and does it have power?",
                     line_->name(), speeds()),
         speeds());
  fail(ScannerProblem::not_a_scanner,
       fmt::format("what comes from {} is not from an RPLIDAR, at {} baud: is it the port of another device?",
                   line_->name(), speeds()),
       speeds());
}

bool Driver::answers_at(unsigned baud) {
  line_->open(baud);
  baud_ = baud;
  send(Command::stop);  // another program may have left it scanning
  drain();
  const auto answer = ask(Command::get_info, AnswerType::info, Info::kBytes, kAnswer);
  if (answer) info_ = info_in(*answer);
  return answer.has_value();
}

void Driver::require_health() {
  for (const bool may_reset : {true, false}) {
    const auto answer = ask(Command::get_health, AnswerType::health, Health::kBytes, kAnswer);
    if (!answer)
      fail(
          ScannerProblem::refuses,
          fmt::format("the laser scanner at {} does not say how it is: switch it off and on", line_->name()));
    const Health health = health_in(*answer);
    if (health.status != HealthStatus::error) return;
    const std::string code = fmt::format("0x{:04X}", health.code);
    if (!may_reset)
      fail(ScannerProblem::unhealthy,
           fmt::format("the laser scanner at {} reports the error {}, and a reset did not help: switch it "
                       "off, look whether "
                       "something holds its motor, and switch it on again",
                       line_->name(), code),
           code);
    send(Command::reset);
    const microseconds until = line_->now() + kRestart;
    while (line_->now() < until && read_more(until)) received_.clear();  // it greets with text
  }
}

SampleTimes Driver::ask_sample_times() {
  const auto answer = ask(Command::get_sample_rate, AnswerType::sample_rate, SampleTimes::kBytes, kAnswer);
  SampleTimes times = answer ? sample_times_in(*answer) : SampleTimes{};
  if (times.standard_us == 0) times.standard_us = kUsualSample_us;
  return times;
}

void Driver::start_scan() {
  if (has_motor_pwm(info_)) {
    Bytes pwm;
    append(pwm, kMotorPwm);
    send(Command::set_motor_pwm, pwm);
  }
  constexpr std::array kExpress{AnswerType::capsules, AnswerType::dense_capsules, AnswerType::nodes};
  constexpr std::array kStandard{AnswerType::nodes};
  const SampleTimes times = ask_sample_times();
  std::optional<Descriptor> answer;
  double sample_us = times.express_us;
  if (times.express_us > 0 && times.express_us < times.standard_us) {
    send(Command::express_scan, kExpressPayload);
    answer = await_descriptor(kExpress, kAnswer);
    if (!answer) send(Command::stop);
  }
  if (!answer) {
    drain();
    sample_us = times.standard_us;
    send(Command::scan);
    answer = await_descriptor(kStandard, kAnswer);
  }
  if (!answer)
    fail(ScannerProblem::refuses,
         fmt::format("the laser scanner at {} does not begin to scan: switch it off and on", line_->name()));
  nodes_.emplace(answer->type);
  turns_.emplace(1e-6 * sample_us, delay_s(1e-6 * sample_us, answer->type, baud_), range_of(info_));
  heard_at_ = counting_from_ = line_->now();
}

std::vector<lidar::Scan> Driver::poll(microseconds timeout) {
  std::array<std::uint8_t, 4096> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const std::size_t count = line_->read(bytes, timeout);
  const microseconds now = line_->now();
  append(received_, ByteView(bytes).first(count));
  const std::vector<Node> nodes = nodes_->take(std::exchange(received_, {}));
  turns_->add(nodes, nodes_->received(), now);
  watch_damage(count);
  if (!nodes.empty()) heard_at_ = now;
  if (now - heard_at_ >= kSilence)
    fail(ScannerProblem::stopped,
         fmt::format("the laser scanner at {} has sent no measurement for {} s: does its motor turn?",
                     line_->name(), kSilence / 1s),
         std::to_string(kSilence / 1s));
  return turns_->take();
}

void Driver::watch_damage(std::size_t bytes) {
  bytes_ += static_cast<std::int64_t>(bytes);
  if (line_->now() - counting_from_ < kDamageWindow) return;
  const std::int64_t skipped = nodes_->skipped_bytes() - skipped_before_;
  if (static_cast<double>(skipped) > kMostDamage * static_cast<double>(bytes_))
    fail(ScannerProblem::damaged, fmt::format("most of what comes from the laser scanner at {} is damaged: "
                                              "try another cable or another USB port",
                                              line_->name()));
  counting_from_ = line_->now();
  skipped_before_ = nodes_->skipped_bytes();
  bytes_ = 0;
}

void Driver::send(Command command, ByteView payload) { line_->write(request(command, payload)); }

/// Reads and forgets until the line is quiet, or for half a second.
void Driver::drain() {
  const microseconds until = line_->now() + kLongestFlood;
  while (line_->now() < until && read_more(line_->now() + kQuiet)) received_.clear();
  received_.clear();
}

/// False if nothing came until then.
bool Driver::read_more(microseconds deadline) {
  std::array<std::uint8_t, 4096> bytes;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const std::size_t count = line_->read(bytes, std::max(deadline - line_->now(), microseconds(0)));
  append(received_, ByteView(bytes).first(count));
  heard_ = heard_ || count > 0;
  return count > 0;
}

std::optional<Bytes> Driver::ask(Command command, AnswerType type, std::size_t bytes, microseconds timeout) {
  received_.clear();
  send(command);
  const microseconds deadline = line_->now() + timeout;
  do {
    const auto found = find_descriptor(received_, type);
    if (found && found->descriptor.bytes == bytes && received_.size() >= found->end + bytes)
      return Bytes(received_.begin() + static_cast<std::ptrdiff_t>(found->end),
                   received_.begin() + static_cast<std::ptrdiff_t>(found->end + bytes));
  } while (line_->now() < deadline && read_more(deadline));
  return std::nullopt;
}

/// What stands behind the descriptor stays in received_.
std::optional<Descriptor> Driver::await_descriptor(std::span<const AnswerType> types, microseconds timeout) {
  received_.clear();
  const microseconds deadline = line_->now() + timeout;
  do {
    for (const AnswerType type : types)
      if (const auto found = find_descriptor(received_, type)) {
        received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(found->end));
        return found->descriptor;
      }
  } while (line_->now() < deadline && read_more(deadline));
  return std::nullopt;
}

}  // namespace astro::truth::rplidar
