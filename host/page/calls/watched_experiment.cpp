#include "host/page/calls/watched_experiment.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/report_input.hpp"
#include "host/experiment/analysis/results.hpp"
#include "host/experiment/drive/experiment.hpp"
#include "host/page/calls/question.hpp"
#include "host/report/report.hpp"
#include "host/simulation/robot/in_process.hpp"

namespace astro::page {
namespace {

using nlohmann::json;

// A page draws the way so far; a second of it is 30 cm at the usual speed.
constexpr std::size_t kPointsOfAnEvent = 10;
constexpr std::int64_t kBetweenPoints_us = 100'000;

/// The two ways of a drive, each in the frame of its own start.
class Ways {
 public:
  Ways(std::shared_ptr<simulation::VirtualRobot> robot, const Emit& emit)
      : robot_(std::move(robot)), emit_(emit) {}

  void begin() {
    start_ = pose_of(robot_->board().truth());
    due_us_ = 0;
    odometry_.clear();
    truth_.clear();
  }

  void moved(const recording::OdometrySample& sample) {
    if (sample.time_us < due_us_) return;
    due_us_ = sample.time_us + kBetweenPoints_us;
    const Pose2 truth = start_.inverse() * pose_of(robot_->board().truth());
    odometry_.insert(odometry_.end(), {sample.x_m, sample.y_m});
    truth_.insert(truth_.end(), {truth.x_m, truth.y_m});
    if (truth_.size() >= 2 * kPointsOfAnEvent) flush();
  }

  void flush() {
    if (truth_.empty()) return;
    emit_(
        {{"event", "way"}, {"odometry", std::exchange(odometry_, {})}, {"truth", std::exchange(truth_, {})}});
  }

 private:
  std::shared_ptr<simulation::VirtualRobot> robot_;
  const Emit& emit_;
  Pose2 start_;
  std::int64_t due_us_ = 0;
  std::vector<double> odometry_, truth_;
};

}  // namespace

experiment::Plan plan_in(const json& question) {
  experiment::Plan plan;
  plan.runs = static_cast<int>(number_in(question, "runs", 1, 50).value_or(5));
  plan.side_m = number_in(question, "side_m", 0.2, 20).value_or(3);
  plan.truth = "sim";
  plan.check();
  return plan;
}

json watched_experiment(robot::Client& client, const std::shared_ptr<simulation::VirtualRobot>& robot,
                        const experiment::Plan& plan, const std::filesystem::path& folder,
                        const std::string& name, const Emit& emit, const experiment::RunHooks& run) {
  simulation::CameraTruth truth(robot);
  Ways ways(robot, emit);
  experiment::ExperimentHooks hooks;
  hooks.run = run;
  hooks.run_started = [&](const experiment::RunSpec& spec, int number, int total) {
    emit({{"event", "run"},
          {"title", spec.title()},
          {"phase", spec.phase},
          {"number", number},
          {"total", total}});
    ways.begin();
  };
  hooks.run.moved = [&](const recording::OdometrySample& sample) { ways.moved(sample); };
  hooks.run_finished = [&](const experiment::RunSpec&, const recording::Run&) { ways.flush(); };
  hooks.calibrated = [&](const experiment::Calibration& found, const auto&) {
    emit({{"event", "calibrated"}, {"calibration", experiment::to_json(found)}});
  };
  const std::filesystem::path runs = folder / kMade / name;
  std::filesystem::remove_all(runs);
  const experiment::Results results = experiment::run_experiment(client, truth, plan, runs, hooks);
  const std::filesystem::path report = runs / "report.html";
  report::write_report(report, experiment::report_input(results));
  return {{"results", experiment::to_json(results)},
          {"verdict", results.verdict()},
          {"report", report.lexically_relative(folder).string()}};
}

}  // namespace astro::page
