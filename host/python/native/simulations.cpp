#include "host/python/native/simulations.hpp"

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

#include "host/experiment/drive/record_run.hpp"
#include "host/python/native/runs.hpp"
#include "host/robot/client/client.hpp"
#include "host/robot/motion/paths.hpp"
#include "host/robot/parameters/upload.hpp"
#include "host/simulation/robot/in_process.hpp"
#include "host/simulation/robot/robot_options.hpp"
#include "host/simulation/robot/virtual_robot.hpp"
#include "host/simulation/study/kinematic_source.hpp"
#include "host/simulation/study/simulated_source.hpp"
#include "host/simulation/study/study.hpp"
#include "host/simulation/study/summary.hpp"

namespace astro::python {
namespace {

using simulation::MocapConfig, simulation::RobotOptions;
using simulation::study::TrialSetup;

/// kind, length_nm, angle, speed_umps, yaw_rate_uradps of protocol::AddSegment.
using Segment = std::tuple<int, std::int64_t, std::int64_t, std::int32_t, std::int32_t>;

robot::Path path_of(const std::vector<Segment>& segments) {
  robot::Path path;
  for (const auto& [kind, length_nm, angle, speed_umps, yaw_rate_uradps] : segments)
    path.push_back({.kind = static_cast<protocol::SegmentKind>(kind),
                    .length_nm = length_nm,
                    .angle = angle,
                    .speed_umps = speed_umps,
                    .yaw_rate_uradps = yaw_rate_uradps});
  return path;
}

/// The firmware on the simulated board, switched on, in this process and in virtual time.
class SimulatedRobot {
 public:
  SimulatedRobot(const RobotOptions& robot, const MocapConfig& cameras)
      : robot_(std::make_shared<simulation::VirtualRobot>(simulation::config_of(robot), cameras)),
        client_(std::make_unique<simulation::InProcessTransport>(robot_)),
        truth_(robot_) {
    client_.connect();
    client_.pump(std::chrono::milliseconds(50));  // until it has booted
  }

  std::map<std::string, double> parameters() {
    const py::gil_scoped_release others_run;
    const std::lock_guard alone(mutex_);
    return fetched();
  }

  void load(const std::map<std::string, double>& values) {
    const py::gil_scoped_release others_run;
    const std::lock_guard alone(mutex_);
    robot::upload(client_, std::map<std::string, robot::Value>(values.begin(), values.end()));
  }

  NamedRun drive(const std::string& name, const std::vector<Segment>& segments) {
    const py::gil_scoped_release others_run;
    const std::lock_guard alone(mutex_);
    // PyErr_CheckSignals tells of each signal once, and the drive asks more than once.
    bool interrupted = false;
    experiment::RunHooks hooks;
    hooks.interrupted = [&interrupted] {
      if (interrupted) return true;
      const py::gil_scoped_acquire python;
      return interrupted = PyErr_CheckSignals() != 0;
    };
    try {
      return {name, experiment::record_run(client_, truth_, path_of(segments),
                                           experiment::info_of(client_.robot(), fetched()), hooks)};
    } catch (const std::exception&) {
      if (!interrupted) throw;
      const py::gil_scoped_acquire python;
      throw py::error_already_set();
    }
  }

 private:
  std::map<std::string, double> fetched() { return robot::RemoteParameters::fetch(client_).numbers(); }

  std::mutex mutex_;  // callers release Python's lock, so two threads may call at the same time
  std::shared_ptr<simulation::VirtualRobot> robot_;
  robot::Client client_;
  simulation::CameraTruth truth_;
};

const simulation::study::DriveSource& source_of(simulation::study::Model model) {
  static const simulation::study::KinematicSource kinematic;
  static const simulation::SimulatedSource simulated;
  if (model == simulation::study::Model::simulator) return simulated;
  return kinematic;
}

py::dict row_of(const simulation::study::Row& row) {
  using namespace pybind11::literals;  // NOLINT(google-build-using-namespace): _a
  return py::dict("method"_a = row.name, "trials"_a = row.trials, "rms"_a = row.rms, "se"_a = row.se);
}

py::dict result_of(const simulation::study::Summary& summary) {
  using namespace pybind11::literals;  // NOLINT(google-build-using-namespace): _a
  py::list methods;
  for (const simulation::study::Row& row : summary.methods) methods.append(row_of(row));
  return py::dict("methods"_a = methods, "bound"_a = row_of(summary.bound), "failures"_a = summary.failures);
}

py::dict run_study(const TrialSetup& setup, int jobs) {
  const simulation::study::DriveSource& source = source_of(setup.model);
  const simulation::study::Summary summary = [&] {
    const py::gil_scoped_release others_run;
    source.check(setup);
    const auto meanwhile = [](int, int) {
      const py::gil_scoped_acquire python;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    };
    return simulation::study::summarize(setup, source,
                                        simulation::study::run_study(setup, source, {}, jobs, meanwhile));
  }();
  return result_of(summary);
}

void set_model(TrialSetup& setup, const std::string& name) {
  const auto model = simulation::study::model_named(name);
  if (!model) throw py::value_error("the model must be kinematic or simulator");
  setup.model = *model;
}

}  // namespace

void bind_simulations(py::module_& module) {
  py::class_<RobotOptions>(module, "RobotOptions")
      .def(py::init<>())
      .def_readwrite("true_wheelbase_m", &RobotOptions::true_wheelbase_m)
      .def_readwrite("true_ed", &RobotOptions::true_ed)
      .def_readwrite("scale", &RobotOptions::scale)
      .def_readwrite("true_e", &RobotOptions::true_e)
      .def_readwrite("slip_m", &RobotOptions::slip_m)
      .def_readwrite("seed", &RobotOptions::seed);
  py::class_<MocapConfig>(module, "Cameras")
      .def(py::init<>())
      .def_readwrite("rate_hz", &MocapConfig::rate_hz)
      .def_readwrite("position_sd_m", &MocapConfig::position_sd_m)
      .def_readwrite("heading_sd_rad", &MocapConfig::heading_sd_rad)
      .def_readwrite("ahead_m", &MocapConfig::ahead_m)
      .def_readwrite("left_m", &MocapConfig::left_m)
      .def_readwrite("seed", &MocapConfig::seed);
  py::class_<SimulatedRobot>(module, "SimulatedRobot")
      .def(py::init<const RobotOptions&, const MocapConfig&>())
      .def("parameters", &SimulatedRobot::parameters)
      .def("load", &SimulatedRobot::load)
      .def("drive", &SimulatedRobot::drive);
  py::class_<TrialSetup>(module, "StudySetup")
      .def(py::init<>())
      .def_property(
          "model", [](const TrialSetup& setup) { return std::string(name_of(setup.model)); }, &set_model)
      .def_readwrite("trials", &TrialSetup::trials)
      .def_readwrite("seed", &TrialSetup::seed)
      .def_readwrite("runs", &TrialSetup::runs)
      .def_readwrite("side_m", &TrialSetup::side_m)
      .def_readwrite("circles", &TrialSetup::circles)
      .def_readwrite("circle_radius_m", &TrialSetup::circle_radius_m)
      .def_readwrite("wheelbase_m", &TrialSetup::wheelbase_m)
      .def_readwrite("E_d", &TrialSetup::E_d)
      .def_readwrite("E_b", &TrialSetup::E_b)
      .def_readwrite("scale", &TrialSetup::scale)
      .def_readwrite("e", &TrialSetup::e)
      .def_property(
          "K_m", [](const TrialSetup& setup) { return setup.noise.K_m; },
          [](TrialSetup& setup, double K_m) { setup.noise.K_m = K_m; })
      .def_property(
          "sigma_xy_m", [](const TrialSetup& setup) { return setup.noise.sigma_xy_m; },
          [](TrialSetup& setup, double sigma_xy_m) { setup.noise.sigma_xy_m = sigma_xy_m; })
      .def_property(
          "sigma_theta_rad", [](const TrialSetup& setup) { return setup.noise.sigma_theta_rad; },
          [](TrialSetup& setup, double sigma_theta_rad) { setup.noise.sigma_theta_rad = sigma_theta_rad; })
      .def_readwrite("truth_rate_hz", &TrialSetup::truth_rate_hz)
      .def_readwrite("clock_known", &TrialSetup::clock_known)
      .def_readwrite("noise_known", &TrialSetup::noise_known);
  module.def("run_study", &run_study);
}

}  // namespace astro::python
