#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "host/live/driver/driver.hpp"
#include "host/simulation/robot/in_process.hpp"
#include "tests/support/robots/drive_of.hpp"
#include "tests/support/ros2/fake_middleware.hpp"

namespace astro::support {

/// The cable between a robot of this process and its host: it can be pulled, and another robot put at its end.
class Cable {
 public:
  explicit Cable(std::shared_ptr<simulation::VirtualRobot> robot) : robot_(std::move(robot)) {}

  void pull() { ++pulls_; }
  /// Pulls it when the host has written so often from now on.
  void pull_after(int writes) { writes_left_ = writes; }
  void plug_in() { plugged_for_ = pulls_; }
  /// As a bad line does: it stays open, and nothing comes through one way.
  void lose_requests(bool lose) { loses_requests_ = lose; }
  void lose_answers(bool lose) { loses_answers_ = lose; }
  /// Whatever the host says reaches the robot so much later, as over a slow radio; it waits for an answer in any case.
  void delay_ms(int ms) { delay_ms_ = ms; }
  /// The host's computer slept so long, and its clock stood.
  void sleep(microseconds time) { slept_ += time; }
  microseconds slept() const { return slept_; }
  void exchange_robot(std::shared_ptr<simulation::VirtualRobot> robot) { robot_ = std::move(robot); }

  std::unique_ptr<robot::Transport> open() {
    if (!plugged()) throw Error("there is no port");
    auto transport = std::make_unique<Line>(*this, robot_);
    transport->reopen({});  // whatever was under way is lost
    return transport;
  }

 private:
  class Line : public simulation::InProcessTransport {
   public:
    Line(Cable& cable, std::shared_ptr<simulation::VirtualRobot> robot)
        : InProcessTransport(std::move(robot)), cable_(cable), opened_at_(cable.pulls_) {}
    void write(std::span<const std::uint8_t> bytes) override {
      require_whole();
      if (cable_.writes_left_ > 0 && --cable_.writes_left_ == 0) cable_.pull();
      for (int i = 0; i < cable_.delay_ms_; ++i) cable_.robot_->step();
      if (!cable_.loses_requests_) InProcessTransport::write(bytes);
    }
    std::size_t read(std::span<std::uint8_t> into, microseconds timeout) override {
      require_whole();
      const std::size_t count = InProcessTransport::read(into, timeout);
      return cable_.loses_answers_ ? 0 : count;
    }

    microseconds now() const override { return InProcessTransport::now() - cable_.slept_; }

   private:
    void require_whole() const {
      if (cable_.pulls_ != opened_at_) throw robot::LinkLost("the cable was pulled");
    }
    Cable& cable_;
    int opened_at_;
  };

  bool plugged() const { return plugged_for_ == pulls_; }

  std::shared_ptr<simulation::VirtualRobot> robot_;
  int pulls_ = 0, plugged_for_ = 0, delay_ms_ = 0, writes_left_ = 0;
  microseconds slept_{};
  bool loses_requests_ = false, loses_answers_ = false;
};

/// A simulated robot, its driver and a middleware without a wire, in virtual time.
class RobotOnRos {
 public:
  static constexpr std::int64_t kStart_ns = 1'790'000'000'000'000'000;  // of the time since 1970

  explicit RobotOnRos(const sim::Config& config = quiet(), live::DriverOptions options = of_both_types())
      : robot(std::make_shared<simulation::VirtualRobot>(config, simulation::MocapConfig{})), cable(robot) {
    options.clock = {[this] { return now(); },
                     [this] { return kStart_ns + now().count() * 1000 + utc_steps_ns; }};
    ros.on_wait = [this](microseconds most) { silence_ms(static_cast<int>(most.count() / 1000)); };
    driver.emplace(
        std::vector<live::Middleware*>{&ros}, [this] { return cable.open(); }, std::move(options));
  }

  /// So that tests may say either.
  static live::DriverOptions of_both_types() {
    live::DriverOptions options;
    options.cmd_vel_type = live::CommandType::both;
    return options;
  }
  static sim::Config quiet() {
    sim::Config config;
    config.slip_m = 0;
    return config;
  }

  microseconds now() const {
    return microseconds(static_cast<std::int64_t>(robot->board().world_us())) - cable.slept();
  }
  std::int64_t utc_ns() const { return kStart_ns + now().count() * 1000; }

  /// The driver works; time passes.
  void run_ms(int ms) {
    const microseconds until = now() + std::chrono::milliseconds(ms);
    while (now() < until) driver->step();
  }
  /// Time passes without the driver.
  void silence_ms(int ms) {
    for (int i = 0; i < ms; ++i) robot->step();
  }
  /// Time passes while the host's computer sleeps; of its clocks only that of the system goes on.
  void sleep_ms(int ms) {
    silence_ms(ms);
    cable.sleep(std::chrono::milliseconds(ms));
    utc_steps_ns += std::int64_t{1'000'000} * ms;
  }
  /// The driver works until a condition holds; false if it does not within `limit_ms`.
  template <class Condition>
  bool run_until(Condition condition, int limit_ms = 5000) {
    const microseconds until = now() + std::chrono::milliseconds(limit_ms);
    while (!condition() && now() < until) driver->step();
    return condition();
  }

  ros2::msg::Trigger::Response call(const std::string& service) {
    return ros.call<ros2::msg::Trigger>(service);
  }
  void say_velocity(double v_mps, double omega_radps) {
    ros2::msg::Twist twist;
    twist.linear.x = v_mps;
    twist.angular.z = omega_radps;
    ros.say("/cmd_vel", twist);
  }
  /// Says a velocity every 50 ms, as others do.
  void drive_ms(int ms, double v_mps, double omega_radps) {
    for (int i = 0; i < ms; i += 50) {
      say_velocity(v_mps, omega_radps);
      run_ms(50);
    }
  }

  /// Another program sets a parameter of the robot, over its other port.
  void set_elsewhere(const std::string& name, double value) {
    robot::Client other(std::make_unique<simulation::InProcessTransport>(robot, 1));
    other.connect();
    auto parameters = robot::RemoteParameters::fetch(other);
    parameters.stage(name, value);
    parameters.commit();
  }

  protocol::Mode mode() { return drive_of(*robot).mode(); }
  bool moves() { return !drive_of(*robot).wheels().stopped(); }
  /// A value of a status in the newest /diagnostics; "" if it does not say it.
  std::string diagnosed(const std::string& status, const std::string& key) {
    for (const auto& each : diagnostics().status)
      if (each.name.ends_with(status))
        for (const auto& value : each.values)
          if (value.key == key) return value.value;
    return "";
  }
  ros2::msg::DiagnosticStatus status(const std::string& of) {
    for (const auto& each : diagnostics().status)
      if (each.name.ends_with(of)) return each;
    return {};
  }
  const ros2::msg::DiagnosticArray& diagnostics() {
    for (auto& each : ros.take<ros2::msg::DiagnosticArray>("/diagnostics")) diagnostics_ = std::move(each);
    return diagnostics_;
  }

  std::shared_ptr<simulation::VirtualRobot> robot;
  Cable cable;
  test::FakeMiddleware ros;
  std::optional<live::Driver> driver;
  std::int64_t utc_steps_ns = 0;  // the system's clock is corrected by this

 private:
  ros2::msg::DiagnosticArray diagnostics_;
};

}  // namespace astro::support
