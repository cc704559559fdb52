#pragma once

#include <filesystem>
#include <string>

namespace astro::target {

/// What a command prints. Throws if it fails.
std::string output_of(const std::string& command);

/// The name of a function as a person writes it: without mangling, and without the compiler's remarks on
/// clones.
std::string readable(const std::string& linker_name);

/// Builds small programs for the robot's processor that do what an image must not do, so that each check is
/// seen to find something. They live in a folder of their own for as long as this object.
class Control {
 public:
  Control();
  ~Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  /// The ELF file of `source`, linked as an image is; the program begins with the function `begin`.
  std::string program(const std::string& source, const std::string& flags = "") const;

 private:
  std::filesystem::path folder_;
};

}  // namespace astro::target
