// Calibrations and parameter files.
#include <fstream>
#include <iterator>

#include "host/base/error.hpp"
#include "host/experiment/analysis/calibration_file.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/target.hpp"

namespace astro::fuzz {

void take(ByteView input) {
  static const InputFile file("x.toml");
  try {
    experiment::read_parameter_file(file.holding(input));
  } catch (const Error&) {
  }
}

std::vector<Bytes> seeds() {
  const InputFile file("x.toml");
  const auto written = [&] {
    std::ifstream text(file.path(), std::ios::binary);
    return Bytes((std::istreambuf_iterator<char>(text)), {});
  };
  std::vector<Bytes> all;
  experiment::Calibration calibration;
  calibration.robot = {"astro", "07"};
  calibration.wheel = experiment::NominalWheel{0.076, 1440};
  experiment::write_calibration(file.path(), calibration);
  all.push_back(written());
  experiment::write_parameters(file.path(), {{"b", 0.29}, {"robot_name", std::string("a\"b")}});
  all.push_back(written());
  all.push_back(
      bytes_of("[parameters]\nx = '''a'b''' # c\n[covariance]\nmatrix = [[1,2,3],[4,5,6],[7,8,9]]\n"
               "[a.b.'c']\nd = { e.f = 1, g = [ 2020-01-01 ] }\n"));
  return all;
}

}  // namespace astro::fuzz
