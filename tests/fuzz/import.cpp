// Files of any format through all that an import does with them: what is in them, wheels and truth, the drive that they
// make with a good file, sizes of a robot. The first byte says what the rest is taken for.
#include "host/base/error.hpp"
#include "host/import/drives/file_inspection.hpp"
#include "host/import/drives/import_drives.hpp"
#include "tests/fuzz/input_file.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/host/import/drives/file_samples.hpp"

namespace astro::fuzz {
namespace {

namespace fs = std::filesystem;

/// What the file that the input becomes is called: its end counts for settings alone.
enum class Use : std::uint8_t { wheels, truth, both, toml, yaml };
constexpr std::uint8_t kUses = 5;

template <class Work>
void try_to(const fs::path& path, Work work) {
  try {
    work();
  } catch (const Error& error) {
    require(std::string(error.what()).find(path.filename().string()) != std::string::npos,
            "errors name the file");
  }
}

/// A good drive beside the input.
struct Bench {
  InputFile file{"input"}, toml{"input.toml"}, yaml{"input.yaml"};
  fs::path wheels = file.folder() / "wheels", truth = file.folder() / "truth";
  importing::ImportChoices choices;

  Bench() {
    test::write_counts(wheels, test::short_drive());
    test::write_tum(truth, test::short_drive());
    choices.geometry.wheel_diameter_m = test::kDiameter_m;
    choices.geometry.counts_per_turn = test::kCountsPerTurn;
    choices.geometry.wheelbase_m = 0.29;
  }

  void import(const importing::DriveFiles& files, const fs::path& input) {
    try_to(input, [&] {
      const importing::ImportedDrives drives = importing::import_drives(std::span(&files, 1), choices);
      for (const recording::Run& run : drives.set.runs) {
        for (std::size_t i = 1; i < run.odometry.size(); ++i)
          require(run.odometry[i].time_us >= run.odometry[i - 1].time_us, "odometry is in order of time");
        require(!run.truth.empty() && !run.odometry.empty(), "a drive has both streams");
      }
    });
  }
};

}  // namespace

void take(ByteView input) {
  static Bench bench;
  if (input.empty()) return;
  const auto use = static_cast<Use>(input[0] % kUses);
  const fs::path path = (use == Use::toml   ? bench.toml
                         : use == Use::yaml ? bench.yaml
                                            : bench.file)
                            .holding(input.subspan(1));
  try_to(path, [&] { importing::inspect_file(path); });
  if (use == Use::toml || use == Use::yaml) return;
  bench.import({use == Use::truth ? bench.wheels : path, use == Use::wheels ? bench.truth : path}, path);
}

std::vector<Bytes> seeds() {
  const InputFile folder("made");
  std::vector<Bytes> all;
  for (const test::FileSample& sample : test::file_samples(folder.folder())) {
    const Use use = sample.holds == test::Holds::wheels  ? Use::wheels
                    : sample.holds == test::Holds::truth ? Use::truth
                    : sample.holds == test::Holds::both  ? Use::both
                    : sample.name.ends_with(".toml")     ? Use::toml
                                                         : Use::yaml;
    all.push_back({static_cast<std::uint8_t>(use)});
    append(all.back(), ByteView(sample.bytes));
  }
  return all;
}

}  // namespace astro::fuzz
