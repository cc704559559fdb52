#include "host/simulation/study/simulated_source.hpp"

#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "host/base/error.hpp"
#include "host/experiment/analysis/trajectories.hpp"
#include "host/experiment/drive/record_run.hpp"
#include "host/recording/end_error.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/robot/parameters/upload.hpp"
#include "host/simulation/robot/in_process.hpp"
#include "host/simulation/study/synthetic_drive.hpp"

namespace astro::simulation {
namespace {

using namespace std::chrono_literals;
using simulation::study::TrialSetup;

// Different from the seed of the clocks of a trial.
constexpr std::uint64_t kWheels = 2'000'000, kCameras = 2'000'001;
constexpr double kCountRate_hz = 1000.0 / experiment::kTelemetryPeriod_ms;

sim::Config robot_of(const TrialSetup& setup, double K_m) {
  sim::Config robot;
  robot.nominal_wheelbase_m = setup.wheelbase_m;
  robot.true_ed = setup.E_d;
  robot.scale = setup.scale;
  robot.true_wheelbase_m = setup.actual().b_m;
  robot.true_e = setup.e;
  // The simulator's slip is per metre that the true wheel rolls, the study's per metre of the nominal wheel.
  robot.slip_m = K_m / setup.scale;
  return robot;
}

simulation::MocapConfig cameras_of(const TrialSetup& setup, const calibration::NoiseModel& noise) {
  simulation::MocapConfig cameras;
  cameras.rate_hz = setup.truth_rate_hz;
  cameras.position_sd_m = noise.sigma_xy_m;
  cameras.heading_sd_rad = noise.sigma_theta_rad;
  return cameras;
}

experiment::Plan plan_of(const TrialSetup& setup) {
  experiment::Plan plan;
  plan.runs = setup.runs;
  plan.side_m = setup.side_m;
  plan.circle_radius_m = setup.circle_radius_m;
  return plan;
}

experiment::RunSpec spec_of(const TrialSetup& setup, int run) {
  const bool square = setup.is_square(run);
  const int index = square ? run : run - 2 * setup.runs;
  return {"", square ? "square" : "circle", simulation::study::sense_of(run), index / 2 + 1};
}

robot::Path segments_of(const experiment::Plan& plan, const experiment::RunSpec& spec) {
  if (spec.kind == "square") return experiment::path_of(plan, spec);
  return robot::circle(plan.circle_radius_m, simulation::study::kCircleTurns, spec.direction.value(),
                       {plan.speed_mps, plan.yaw_rate_radps});
}

/// A robot that is switched on, with the parameters of the set-up loaded.
class SimulatedRobot {
 public:
  SimulatedRobot(const sim::Config& config, const simulation::MocapConfig& cameras, const TrialSetup& setup)
      : robot_(std::make_shared<simulation::VirtualRobot>(config, cameras)),
        client_(std::make_unique<simulation::InProcessTransport>(robot_)),
        truth_(robot_),
        plan_(plan_of(setup)) {
    client_.connect();
    client_.pump(50ms);  // until it has booted
    const double loaded_m = robot::RemoteParameters::fetch(client_).number("b");
    if (std::abs(loaded_m - setup.wheelbase_m) > 1e-9) robot::upload(client_, {{"b", setup.wheelbase_m}});
    parameters_ = robot::RemoteParameters::fetch(client_).numbers();
  }

  recording::Run drive(const experiment::RunSpec& spec) {
    recording::RunInfo info = experiment::info_of(plan_, spec);
    info.parameters = parameters_;
    return experiment::record_run(client_, truth_, segments_of(plan_, spec), info, {});
  }

 private:
  std::shared_ptr<simulation::VirtualRobot> robot_;
  robot::Client client_;
  simulation::CameraTruth truth_;
  experiment::Plan plan_;
  std::map<std::string, double> parameters_;
};

simulation::study::Drives driven(const sim::Config& robot, const simulation::MocapConfig& cameras,
                                 const TrialSetup& setup) {
  SimulatedRobot simulated(robot, cameras, setup);
  simulation::study::Drives drives;
  for (int run = 0; run < setup.run_count(); ++run) {
    const recording::Run recorded = simulated.drive(spec_of(setup, run));
    drives.runs.push_back(experiment::trajectory_of(recorded, simulation::study::name_of(setup, run)));
    if (!setup.is_square(run)) continue;
    drives.end_errors.push_back(recording::end_error(recorded));
  }
  return drives;
}

}  // namespace

void SimulatedSource::check(const TrialSetup& setup) const {
  setup.require(simulation::study::Model::simulator);
  setup.check();
  plan_of(setup).check();
  if (setup.windup_rad != 0)
    throw Error(
        "the simulated robot's tyres do not wind up in spins: only the robot of the kinematic model does",
        simulation::study::SetupProblem::windup_not_simulated);
  if (setup.count_rate_hz != kCountRate_hz)
    throw Error("the simulated robot's counts are recorded at " + std::to_string(std::lround(kCountRate_hz)) +
                    " Hz: leave the rate of the counts at that, or take the kinematic model",
                simulation::study::SetupProblem::count_rate_not_recorded);
}

simulation::study::Drives SimulatedSource::of_trial(const TrialSetup& setup, int trial) const {
  const std::uint64_t seed = simulation::study::seed_of(setup, trial);
  sim::Config robot = robot_of(setup, setup.noise.K_m);
  simulation::MocapConfig cameras = cameras_of(setup, setup.noise);
  robot.seed = simulation::study::derived_seed(seed, kWheels);
  cameras.seed = simulation::study::derived_seed(seed, kCameras);
  simulation::study::Drives drives = driven(robot, cameras, setup);
  const std::vector<double> offsets_s = clock_offsets_s(setup, trial);
  for (std::size_t run = 0; run < drives.runs.size(); ++run)
    for (calibration::BodySample& sample : drives.runs[run].truth) sample.time_s -= offsets_s[run];
  return drives;
}

std::vector<calibration::Trajectory> SimulatedSource::without_noise(const TrialSetup& setup) const {
  return driven(robot_of(setup, 0), cameras_of(setup, {0, 0, 0}), setup).runs;
}

}  // namespace astro::simulation
