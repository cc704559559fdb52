#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>

#include "host/formats/tables/text_file.hpp"
#include "host/import/scans/carmen_log.hpp"
#include "host/lidar/piece_errors.hpp"
#include "host/lidar/scan_calibration.hpp"
#include "tests/support/base/places.hpp"
#include "tests/support/base/temporary_folder.hpp"

/// Logs of real robots, calibrated on their first half. The judge is the second half, by the poses of the mapping program, which
/// the calibration does not use.
namespace astro::importing {
namespace {

constexpr double kWheelbase_m = 0.4;
constexpr calibration::WheelFactors kLoaded{1, 1, kWheelbase_m};

/// The lines from one scan to another, and the mapped poses of the scans in them.
struct Part {
  std::string text;
  std::vector<Pose2> mapped;
};

std::array<Part, 2> halves_of(const std::filesystem::path& path) {
  const Bytes bytes = tables::text_of_file(path);
  const std::string text(as_text(bytes));
  std::size_t scans = 0, seen = 0;
  for (std::size_t at = 0; (at = text.find("\nFLASER ", at)) != std::string::npos; ++at) ++scans;
  std::array<Part, 2> parts;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const bool scan = line.starts_with("FLASER ");
    Part& part = parts[seen > scans / 2 ? 1 : 0];
    part.text += line + '\n';
    if (!scan) continue;
    ++seen;
    std::istringstream words(line);
    std::string word;
    std::size_t count = 0;
    double skipped = 0;
    words >> word >> count;
    for (std::size_t i = 0; i < count; ++i) words >> skipped;
    Pose2 pose;
    words >> pose.x_m >> pose.y_m >> pose.theta_rad;
    part.mapped.push_back(pose);
  }
  return parts;
}

CarmenLog read(const Part& part) {
  static const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "part.log";
  std::ofstream(path) << part.text;
  return read_carmen_log(path, kWheelbase_m);
}

/// Root mean square over all pieces of 20 m.
double error_m(const CarmenLog& log, const Part& part, const lidar::Unknowns& unknowns) {
  std::vector<double> times_s;
  log.drive.read_scans([&](const lidar::Scan& scan) { times_s.push_back(log.drive.seconds(scan)); });
  std::vector<lidar::Stretch> stretches;
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    stretches.push_back(lidar::cut_stretch(log.drive.wheels, kLoaded, times_s[i - 1], times_s[i], 0));
    stretches.back().scanner = {part.mapped[i - 1].between(part.mapped[i]), Eigen::Matrix3d::Identity()};
  }
  return lidar::rms_m(lidar::piece_errors(stretches, 20, unknowns, kLoaded));
}

struct Judged {
  bool better = false;
  double ratio = 0;  // of the error on the second half, found over loaded
};

Judged judged(const std::string& name) {
  const std::array<Part, 2> halves =
      halves_of(support::shared_data() / "carmen" / (name + "-corrected.log.gz"));
  const CarmenLog first = read(halves[0]);
  const lidar::ScanCalibration found = lidar::calibrate_by_scans({&first.drive, 1}, kLoaded);
  const CarmenLog second = read(halves[1]);
  lidar::Unknowns loaded = lidar::nothing_wrong(kLoaded), used = loaded;
  for (lidar::Unknowns* unknowns : {&loaded, &used}) {
    (*unknowns)(lidar::kLeverX) = found.scanner.x_m;
    (*unknowns)(lidar::kLeverY) = found.scanner.y_m;
    (*unknowns)(lidar::kLeverYaw) = found.scanner.theta_rad;
  }
  used(lidar::kScale) = (found.factors.c_r + found.factors.c_l) / 2;
  used(lidar::kTurn) = used(lidar::kScale) * kWheelbase_m / found.factors.b_m;
  used(lidar::kBend) = (found.factors.c_r - found.factors.c_l) / found.factors.b_m;
  used(lidar::kArcs) = found.factors.e;
  const Judged result{found.judged && found.choice.better(),
                      error_m(second, halves[1], used) / error_m(second, halves[1], loaded)};
  fmt::print("{}: {} ({}), error on the second half x {:.2f}\n", name,
             result.better ? "better" : "not better", found.choice.set.name, result.ratio);
  return result;
}

class RealLogs : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(support::shared_data() / "carmen"))
      GTEST_SKIP() << "the logs of CARMEN are not here";
  }
};

TEST_F(RealLogs, OfRobotsThatAreOffBecomeBetterByFortyPercent) {
  for (const char* name : {"intel", "fhw"}) {
    const Judged result = judged(name);
    EXPECT_TRUE(result.better) << name;
    EXPECT_LT(result.ratio, 0.6) << name;
  }
}

TEST_F(RealLogs, OfRobotsThatAreNotShownToBeOffAreNotBetter) {
  for (const char* name : {"csail", "infinite-corridor"}) EXPECT_FALSE(judged(name).better) << name;
}

}  // namespace
}  // namespace astro::importing
