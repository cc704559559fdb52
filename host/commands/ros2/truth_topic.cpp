#include "host/commands/ros2/truth_topic.hpp"

#include "host/base/error.hpp"
#include "host/commands/base/remedies.hpp"
#include "host/console/console.hpp"
#include "host/ros2/messages/geometry.hpp"
#include "host/ros2/recorded/ros_messages.hpp"

namespace astro::commands {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::seconds kRest{1};  // before a source that has failed is asked again

}  // namespace

TruthTopic::TruthTopic(ros2::Middleware& middleware, const ros2::Names& names,
                       std::unique_ptr<truth::Source> source, Open open)
    : open_(std::move(open)),
      source_(std::move(source)),
      publisher_(
          middleware.advertise({names.absolute("truth"), ros2::message_type<ros2::msg::PoseStamped>()})) {}

void TruthTopic::step(ros2::Driver& driver) {
  if (steady_clock::now() < ask_at_) return;
  try {
    if (!source_) source_ = open_();
    publish(driver);
  } catch (const Error& error) {
    if (open_) source_.reset();
    if (!std::exchange(lost_, true)) console::say(in_words(error));
    ask_at_ = steady_clock::now() + kRest;
  }
}

void TruthTopic::publish(ros2::Driver& driver) {
  for (recording::TruthSample sample : source_->poll()) {
    if (std::exchange(lost_, false)) console::say("ground truth comes again");
    const auto time_ns = source_->clock() == "robot" ? driver.utc_of_robot_ns(sample.time_us)
                                                     : driver.utc_of_host_ns(sample.time_us);
    if (!time_ns) continue;
    sample.time_us = *time_ns / 1000;
    publisher_->publish(ros2::encode_truth(sample), *time_ns);
  }
}

}  // namespace astro::commands
