#include "tests/host/experiment/files/older_journal.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/support/base/json.hpp"

namespace astro::test {

void make_older_than_e(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "experiment.json";
  std::ifstream file(path);
  nlohmann::json json = support::parse_json({std::istreambuf_iterator<char>(file), {}});
  for (auto& [phase, loaded] : json.at("carried").items())
    for (const char* key : {"e", "kappa0"}) loaded.erase(key);
  for (const char* key : {"circles", "circle_turns"}) json.at("plan").erase(key);
  std::ofstream(path) << json;
}

}  // namespace astro::test
