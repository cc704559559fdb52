#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/import/drives/file_pairs.hpp"
#include "host/import/drives/stated_drives.hpp"

namespace astro::page {

/// What a file is taken for.
struct Role {
  bool wheels = false, truth = false, robot = false;
};

/// "wheels", "truth", "both" or "none"; throws astro::Error for any other name.
Role role_named(const std::string& name);

/// A file, as far as it can be read: what is wrong with it is kept as its problem and not thrown.
class LookedFile {
 public:
  /// role: none if it is to be recognised by the content. `choices` are those of `stated`.
  LookedFile(std::filesystem::path path, std::optional<Role> role, const importing::StatedDrives& stated,
             const importing::ImportChoices& choices);

  importing::OfferedFile offered() const { return {path_, role_.wheels, role_.truth}; }
  /// As inspect.hpp describes a file.
  nlohmann::json answer() const;

 private:
  void recognise(bool role_is_stated, const importing::StatedDrives& stated);
  void look(const importing::ImportChoices& choices);

  std::filesystem::path path_;
  Role role_;
  bool scans_ = false;
  std::vector<std::string> controllers_;
  nlohmann::json inspection_, problem_, understood_ = nlohmann::json::object(),
                                        preview_ = nlohmann::json::object();
};

}  // namespace astro::page
