#include "host/console/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <type_traits>
#include <utility>

namespace astro::console {

std::size_t Option::count() const { return option_->count(); }

Option Option::required() const { return Option(option_->required()); }

Option Option::needs(Option other) const { return Option(option_->needs(other.option_)); }

Option Option::excludes(Option other) const { return Option(option_->excludes(other.option_)); }

Option Option::type_name(const std::string& name) const { return Option(option_->type_name(name)); }

Option Option::capture_default_str() const { return Option(option_->capture_default_str()); }

Option Option::check(Check check) const {
  return Option(option_->check(CLI::Validator(std::move(check), "")));
}

Option Option::transform(Check transform) const {
  return Option(option_->transform(CLI::Validator(std::move(transform), "")));
}

Option Option::one_of(const std::vector<std::string>& words) const {
  std::string choice;
  for (const std::string& word : words) choice += (choice.empty() ? "" : "|") + word;
  option_->type_name(choice);
  return check([words, choice](const std::string& word) {
    if (std::find(words.begin(), words.end(), word) != words.end()) return std::string();
    return "'" + word + "' is none of " + choice;
  });
}

Option Option::delimiter(char between) const { return Option(option_->delimiter(between)); }

Option Option::one_each_time() const { return Option(option_->expected(1)->take_all()); }

template <OptionValue T>
Option Command::add_option(const std::string& names, T& value, const std::string& what) const {
  CLI::Option* option = app_->add_option(names, value, what);
  // An unset variable of a script leaves an empty word. Without this check a drive would begin and its
  // recordings would have no name.
  if constexpr (std::is_same_v<T, std::filesystem::path>)
    option->check([](const std::string& word) {
      return word.empty() ? std::string("needs the name of a file or folder, and got none") : std::string();
    });
  return Option(option);
}

template Option Command::add_option(const std::string&, double&, const std::string&) const;
template Option Command::add_option(const std::string&, int&, const std::string&) const;
template Option Command::add_option(const std::string&, unsigned&, const std::string&) const;
template Option Command::add_option(const std::string&, std::uint64_t&, const std::string&) const;
template Option Command::add_option(const std::string&, std::string&, const std::string&) const;
template Option Command::add_option(const std::string&, std::filesystem::path&, const std::string&) const;
template Option Command::add_option(const std::string&, std::optional<double>&, const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<std::string>&, const std::string&) const;
template Option Command::add_option(const std::string&, std::vector<std::filesystem::path>&,
                                    const std::string&) const;

Option Command::add_option_function(const std::string& names,
                                    std::function<void(const std::vector<std::string>&)> take,
                                    const std::string& what) const {
  return Option(app_->add_option_function(names, take, what));
}

Option Command::add_flag(const std::string& names, bool& given, const std::string& what) const {
  return Option(app_->add_flag(names, given, what));
}

Command Command::add_subcommand(const std::string& name, const std::string& what) const {
  return Command(app_->add_subcommand(name, what));
}

void Command::under(const std::string& heading, const std::function<void()>& add) const {
  const auto all = [](const CLI::App*) { return true; };
  const std::size_t before = app_->get_subcommands(all).size();
  add();
  const std::vector<CLI::App*> now = app_->get_subcommands(std::function<bool(CLI::App*)>(all));
  for (std::size_t i = before; i < now.size(); ++i) now[i]->group(heading);
}

void Command::alias(const std::string& name) const { app_->alias(name); }

void Command::require_subcommand(std::size_t least, std::size_t most) const {
  app_->require_subcommand(least, most);
}

bool Command::has_subcommand() const { return !app_->get_subcommands().empty(); }

void Command::footer(const std::string& text) const { app_->footer(text); }

void Command::callback(std::function<void()> work) const { app_->callback(std::move(work)); }

}  // namespace astro::console
