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

/// The command line as a command sees it: its options, and what it then does. CLI11 does the work but is
/// named in no other header, because each file that includes CLI11 compiles ten seconds longer.
///
/// Both classes are handles: a copy means the same option or command, and the Program owns them all.
namespace astro::console {

/// Returns what is wrong with a word, or ""; as a transform it may also rewrite the word.
using Check = std::function<std::string(std::string&)>;

/// Types that an option can store its words in.
template <class T>
concept OptionValue = std::same_as<T, double> || std::same_as<T, int> || std::same_as<T, unsigned> ||
    std::same_as<T, std::uint64_t> || std::same_as<T, std::string> ||
    std::same_as<T, std::filesystem::path> || std::same_as<T, std::optional<double>> ||
    std::same_as<T, std::vector<std::string>> || std::same_as<T, std::vector<std::filesystem::path>>;

/// An option, a flag or a positional argument. Each function returns the option, so that calls can be
/// chained.
class Option {
 public:
  Option() = default;  // none yet
  explicit Option(CLI::Option* option) : option_(option) {}

  /// How many times it was given.
  std::size_t count() const;

  Option required() const;
  /// It may be given only together with `other`.
  Option needs(Option other) const;
  /// It may not be given together with `other`.
  Option excludes(Option other) const;

  /// The name of the value in the help; "": none.
  Option type_name(const std::string& name) const;
  /// The help shows the variable's present value as the default.
  Option capture_default_str() const;

  Option check(Check check) const;
  Option transform(Check transform) const;
  /// Accepts only these words; the help lists them.
  Option one_of(const std::vector<std::string>& words) const;

  /// A list in one word: a,b,c for ','.
  Option delimiter(char between) const;
  /// A list that is given by repeating the option, one word each time.
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
  /// Passes the words to `take` instead of storing them.
  Option add_option_function(const std::string& names,
                             std::function<void(const std::vector<std::string>&)> take,
                             const std::string& what) const;
  Option add_flag(const std::string& names, bool& given, const std::string& what) const;

  Command add_subcommand(const std::string& name, const std::string& what) const;
  /// The subcommands that `add` adds stand under `heading` in the help; "" keeps them out of it.
  void under(const std::string& heading, const std::function<void()>& add) const;
  /// Another name of the same command.
  void alias(const std::string& name) const;
  void require_subcommand(std::size_t least, std::size_t most) const;
  /// Whether a subcommand was given.
  bool has_subcommand() const;

  /// Text below the options in the help.
  void footer(const std::string& text) const;
  /// What the command does after the whole command line was parsed.
  void callback(std::function<void()> work) const;

  /// For what is made of a whole command line: help, completion, manual.
  const CLI::App* app() const { return app_; }

 private:
  CLI::App* app_;
};

}  // namespace astro::console
