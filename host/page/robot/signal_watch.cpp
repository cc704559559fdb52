#include "host/page/robot/signal_watch.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace astro::page {

using nlohmann::json;

std::uint32_t SignalWatch::fields() const {
  std::uint32_t fields = 0;
  for (const Signal* each : signals_) fields |= each->field;
  return fields;
}

void SignalWatch::take(const protocol::Telemetry& telemetry, std::uint16_t stream_ms) {
  const std::uint64_t time_us = telemetry.device_time_us;
  if (time_us == taken_us_ || !request_.is_due(time_us, stream_ms)) return;
  taken_us_ = time_us;
  if (times_s_.size() == kMost) {
    times_s_.erase(times_s_.begin());
    for (auto& each : values_) each.erase(each.begin());
    ++missed_;
  }
  times_s_.push_back(static_cast<double>(time_us) / 1e6);
  for (std::size_t i = 0; i < signals_.size(); ++i) values_[i].push_back(signals_[i]->value(telemetry));
}

std::optional<json> SignalWatch::batch(microseconds now) {
  if (times_s_.empty() || (sent_at_ && now - *sent_at_ < kBetweenBatches)) return std::nullopt;
  sent_at_ = now;
  json of_signals = json::object();
  for (std::size_t i = 0; i < signals_.size(); ++i)
    of_signals[std::string(signals_[i]->name)] = std::exchange(values_[i], {});
  return json{{"event", "samples"},
              {"t_s", std::exchange(times_s_, {})},
              {"signals", std::move(of_signals)},
              {"missed", std::exchange(missed_, 0)}};
}

}  // namespace astro::page
