#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// The command line as a command sees it: what can be given to it, and what then happens. CLI11 is behind it
/// and named in no other header: each file that includes CLI11 compiles ten seconds longer.
///
/// Both classes are handles: a copy means the same option or command, and the Program owns them all.
namespace astro::console {

/// Says what is wrong with a word, or nothing; may rewrite it where it transforms.
using Check = std::function<std::string(std::string&)>;

/// What the words of an option can be read into.
template <class T>
concept OptionValue = std::same_as<T, double> || std::same_as<T, int> || std::same_as<T, unsigned> ||
    std::same_as<T, std::uint64_t> || std::same_as<T, std::string> ||
    std::same_as<T, std::filesystem::path> || std::same_as<T, std::optional<double>> ||
    std::same_as<T, std::vector<std::string>> || std::same_as<T, std::vector<std::filesystem::path>>;

/// An option, a flag or a positional argument. Each function gives the option back, for the next one.
class Option {
 public:
  Option() = default;  // none yet
  explicit Option(CLI::Option* option) : option_(option) {}

  /// How often it was given.
  std::size_t count() const;

  Option required() const;
  /// It may be given only together with `other`.
  Option needs(Option other) const;
  /// It may not be given together with `other`.
  Option excludes(Option other) const;

  /// What help calls the value; "": nothing.
  Option type_name(const std::string& name) const;
  /// Help shows the value that the variable has now.
  Option capture_default_str() const;

  Option check(Check check) const;
  Option transform(Check transform) const;
  /// Only these; help lists them.
  Option one_of(const std::vector<std::string>& words) const;

  /// A list in one word: a,b,c for ','.
  Option delimiter(char between) const;
  /// A list by giving the option again, one word each time.
  Option one_each_time() const;

 private:
  CLI::Option* option_ = nullptr;
};

/// A program or one of its subcommands.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}

  /// `names`: "--port,-p", or without dashes for a positional argument. `value` must outlive the command.
  template <OptionValue T>
  Option add_option(const std::string& names, T& value, const std::string& what) const;
  /// Hands the words over instead of keeping them.
  Option add_option_function(const std::string& names,
                             std::function<void(const std::vector<std::string>&)> take,
                             const std::string& what) const;
  Option add_flag(const std::string& names, bool& given, const std::string& what) const;

  Command add_subcommand(const std::string& name, const std::string& what) const;
  void require_subcommand(std::size_t least, std::size_t most) const;
  /// One was given.
  bool has_subcommand() const;

  /// Below the options in help.
  void footer(const std::string& text) const;
  /// What the command does, once all of the command line was understood.
  void callback(std::function<void()> work) const;

 private:
  CLI::App* app_;
};

}  // namespace astro::console
