#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace astro::bag {

/// Why text is not read as YAML. Values: its name and the line.
enum class YamlProblem { not_yaml, nested_too_deep, too_many_values };

/// A value in a YAML file and the keys that lead to it: "controller/ros__parameters/wheel_radius". The entries of a
/// list are numbered from 0: "left_wheel_names/0".
struct YamlScalar {
  std::string path, value;
  int line = 0;         // from 1
  bool quoted = false;  // a text, whatever it looks like
};

/// All scalars of YAML text in their order. Anchors are read where they are defined, and aliases are left out, so that a
/// short text cannot expand without limit. Throws astro::Error naming `name` and the line for text that is no YAML, nests
/// deeper than 64 levels, or would take more than 16 MiB; keep the text below 1 MiB.
std::vector<YamlScalar> yaml_scalars(std::string_view text, std::string_view name);

}  // namespace astro::bag
