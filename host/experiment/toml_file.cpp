#include "host/experiment/toml_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "host/base/error.hpp"
#include "host/recording/files.hpp"

namespace astro::experiment {

toml::table parse_toml(const std::filesystem::path& path) {
  const recording::Bytes bytes = recording::load_file(path);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    return toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    throw Error(fmt::format("'{}' line {} is not TOML: {}", path.string(), error.source().begin.line,
                            error.description()));
  }
}

std::string real_text(double value) {
  if (!std::isfinite(value)) return "nan";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace astro::experiment
