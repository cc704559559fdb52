#include "host/python/native/runs.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "host/base/error.hpp"
#include "host/import/drives/stated_drives.hpp"
#include "host/import/drives/unused_choice.hpp"
#include "host/recording/run_file.hpp"
#include "host/truth/files/rotations.hpp"

namespace astro::python {
namespace {

using Table = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Throws py::value_error unless it is two-dimensional with one of these numbers of columns.
void require_columns(const Table& table, const std::string& what, py::ssize_t least, py::ssize_t most) {
  if (table.ndim() == 2 && table.shape(1) >= least && table.shape(1) <= most) return;
  throw py::value_error(what);
}

std::int64_t nanoseconds(double time_s) {
  constexpr double kMost_s = 9e9;  // what 64 bits hold
  if (!(std::abs(time_s) <= kMost_s)) throw py::value_error("a time is not finite, or beyond 9e9 s");
  return std::llround(time_s * 1e9);
}

importing::WheelTrack wheels_of(const Table& table, const std::string& unit) {
  require_columns(table, "wheels must be an array of three columns: time_s, left, right", 3, 3);
  importing::WheelTrack track;
  track.unit = unit == "counts"    ? importing::WheelUnit::counts
               : unit == "radians" ? importing::WheelUnit::radians
               : unit == "metres"
                   ? importing::WheelUnit::metres
                   : throw py::value_error("the unit of the wheels must be counts, radians or metres");
  const auto cells = table.unchecked<2>();
  for (py::ssize_t i = 0; i < cells.shape(0); ++i) {
    if (!std::isfinite(cells(i, 1)) || !std::isfinite(cells(i, 2)))
      throw py::value_error("wheels hold a value that is not finite");
    track.samples.push_back({nanoseconds(cells(i, 0)), cells(i, 1), cells(i, 2)});
  }
  return track;
}

/// A pose with a NaN was lost by the tracker.
truth::TrackedPose pose_of(double time_s, double x_m, double y_m, double theta_rad) {
  truth::TrackedPose sample{nanoseconds(time_s), {.x_m = x_m, .y_m = y_m}};
  truth::set_rotation(sample.pose, truth::from_euler("Z", {0, 0, theta_rad}));
  sample.valid = truth::is_possible(sample.pose);
  return sample;
}

truth::BodyTrack truth_of(const Table& table) {
  require_columns(table, "truth must be an array of time_s, x_m, y_m and, if it was measured, theta_rad", 3,
                  4);
  const bool headings = table.shape(1) == 4;
  truth::BodyTrack track;
  track.facts.kind = truth::FileKind::plain;
  track.facts.format = "array";
  track.facts.length_unit = "m";
  track.facts.flat = true;
  track.facts.rotation_kind = headings ? truth::RotationKind::heading : truth::RotationKind::none;
  const auto cells = table.unchecked<2>();
  for (py::ssize_t i = 0; i < cells.shape(0); ++i)
    track.samples.push_back(pose_of(cells(i, 0), cells(i, 1), cells(i, 2), headings ? cells(i, 3) : 0));
  return track;
}

std::vector<NamedRun> named(experiment::RunSet set) {
  std::vector<NamedRun> runs;
  for (std::size_t i = 0; i < set.runs.size(); ++i)
    runs.push_back({std::move(set.names[i]), std::move(set.runs[i])});
  return runs;
}

std::vector<NamedRun> runs_of(const std::vector<std::tuple<std::string, Table, Table>>& drives,
                              const std::string& unit, const importing::StatedDrives& stated) {
  importing::refuse_choices_unused_with_arrays(stated);
  std::vector<importing::HeldDrive> held;
  for (const auto& [name, wheels, truth] : drives) {
    importing::ImportedWheels imported;
    imported.track = wheels_of(wheels, unit);
    held.push_back({name, std::move(imported), truth_of(truth)});
  }
  const py::gil_scoped_release others_run;
  return named(importing::import_held(std::move(held), importing::choices_of(stated)).set);
}

std::vector<NamedRun> read_runs(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) return named(experiment::read_run_set(path));
  return {{path.stem().string(), recording::read_run(path)}};
}

template <class Sample>
py::array_t<Sample> array_of(const std::vector<Sample>& samples) {
  return py::array_t<Sample>(static_cast<py::ssize_t>(samples.size()), samples.data());
}

py::dict facts_of(const recording::RunInfo& info) {
  using namespace pybind11::literals;  // NOLINT(google-build-using-namespace): _a
  return py::dict("kind"_a = info.kind, "phase"_a = info.phase, "index"_a = info.index,
                  "size_m"_a = info.size_m, "speed_mps"_a = info.speed_mps, "robot_name"_a = info.robot_name,
                  "board"_a = info.board, "firmware"_a = info.firmware, "started_at"_a = info.started_at,
                  "truth_source"_a = info.truth_source, "truth_clock"_a = info.truth_clock,
                  "truth_scale_sigma"_a = info.truth_scale_sigma, "parameters"_a = info.parameters);
}

}  // namespace

experiment::RunSet set_of(const std::vector<const NamedRun*>& runs, std::vector<std::string> sessions) {
  experiment::RunSet set;
  for (const NamedRun* one : runs) {
    if (one == nullptr) throw py::type_error("there is None in place of a run");
    set.names.push_back(one->name);
    set.runs.push_back(one->run);
  }
  if (!sessions.empty() && sessions.size() != runs.size())
    throw py::value_error("sessions must name one session for each run");
  set.sessions = std::move(sessions);
  return set;
}

void bind_runs(py::module_& module) {
  using recording::OdometrySample, recording::TruthSample;
  PYBIND11_NUMPY_DTYPE(OdometrySample, time_us, x_m, y_m, theta_rad, v_mps, omega_radps, left_counts,
                       right_counts);
  PYBIND11_NUMPY_DTYPE(TruthSample, time_us, x_m, y_m, theta_rad, valid);
  py::class_<NamedRun>(module, "Run")
      .def_readonly("name", &NamedRun::name)
      .def_property_readonly("odometry", [](const NamedRun& run) { return array_of(run.run.odometry); })
      .def_property_readonly("truth", [](const NamedRun& run) { return array_of(run.run.truth); })
      .def_property_readonly("facts", [](const NamedRun& run) { return facts_of(run.run.info); })
      .def_property_readonly(
          "warning", [](const NamedRun& run) { return run.run.warning ? run.run.warning->sentence : ""; })
      .def("write", [](const NamedRun& run, const std::string& path) { recording::write_run(path, run.run); })
      .def("__repr__", [](const NamedRun& run) {
        return "<Run " + run.name + ": " + std::to_string(run.run.odometry.size()) +
               " samples of odometry, " + std::to_string(run.run.truth.size()) + " of ground truth>";
      });
  py::class_<importing::StatedDrives>(module, "Statements")
      .def(py::init<>())
      .def_readwrite("truth_columns", &importing::StatedDrives::truth_columns)
      .def_readwrite("wheels_topic", &importing::StatedDrives::wheels_topic)
      .def_readwrite("wheels_unit", &importing::StatedDrives::wheels_unit)
      .def_readwrite("truth_topic", &importing::StatedDrives::truth_topic)
      .def_readwrite("body", &importing::StatedDrives::body)
      .def_readwrite("up", &importing::StatedDrives::up)
      .def_readwrite("truth_unit", &importing::StatedDrives::unit)
      .def_readwrite("swap_wheels", &importing::StatedDrives::swap_wheels)
      .def_readwrite("reverse_wheels", &importing::StatedDrives::reverse_wheels)
      .def_readwrite("drives_backward", &importing::StatedDrives::drives_backward)
      .def_readwrite("wheel_diameter_m", &importing::StatedDrives::wheel_diameter_m)
      .def_readwrite("counts_per_turn", &importing::StatedDrives::counts_per_turn)
      .def_readwrite("wheelbase_m", &importing::StatedDrives::wheelbase_m)
      .def_property(
          "wheel_columns", [](const importing::StatedDrives& stated) { return stated.table.columns; },
          [](importing::StatedDrives& stated, const std::string& columns) { stated.table.columns = columns; })
      .def_property(
          "per_interval", [](const importing::StatedDrives& stated) { return stated.table.per_interval; },
          [](importing::StatedDrives& stated, bool per_interval) {
            stated.table.per_interval = per_interval;
          })
      .def_property(
          "counter_range", [](const importing::StatedDrives& stated) { return stated.table.counter_range; },
          [](importing::StatedDrives& stated, std::optional<double> range) {
            stated.table.counter_range = range;
          })
      .def_property(
          "robot_file", [](const importing::StatedDrives& stated) { return stated.robot_file.string(); },
          [](importing::StatedDrives& stated, const std::string& file) { stated.robot_file = file; });
  module.def("runs_of", &runs_of);
  module.def("read_runs", [](const std::string& path) {
    const py::gil_scoped_release others_run;
    return read_runs(path);
  });
  module.def("import_runs", [](const std::vector<std::pair<std::string, std::string>>& files,
                               importing::StatedDrives stated) {
    const py::gil_scoped_release others_run;
    for (const auto& [wheels, truth] : files) {
      stated.wheels.emplace_back(wheels);
      stated.truth.emplace_back(truth);
    }
    return named(importing::import_stated(stated).set);
  });
}

}  // namespace astro::python
