#include "host/programs/astrolabe/about.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/base/files.hpp"
#include "host/console/completion.hpp"
#include "host/console/manual.hpp"

namespace astro::commands {
namespace {

// Each script asks the program itself for the words that may follow, so that none of them knows a command or an option.
constexpr const char* kBash = R"(# For ~/.bashrc: source <(astrolabe completion bash)
# Bash takes = and : for words of their own; the program gets the words as they were typed, and bash the rest of the last one.
_astrolabe() {
  local cur=${COMP_WORDS[COMP_CWORD]} line word glue= begun= typed=()
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
    if [[ ${#typed[@]} -gt 0 && ( $glue || $word == [=:]* ) ]]; then typed[-1]+=$word; else typed+=("$word"); fi
    [[ $word == *[=:] ]] && glue=1 || glue=
  done
  [[ $cur == [=:]* ]] && cur=
  [[ ${#typed[@]} -gt 0 ]] && begun=${typed[-1]%"$cur"}
  while IFS= read -r line; do
    if [[ $line == : ]]; then
      compopt -o filenames 2>/dev/null
      mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$cur")
    else
      line=${line%%$'\t'*}
      COMPREPLY+=("${line#"$begun"}")
    fi
  done < <("${COMP_WORDS[0]}" complete -- "${typed[@]}" 2>/dev/null)
}
complete -o default -F _astrolabe astrolabe
)";

constexpr const char* kZsh = R"(#compdef astrolabe
# For ~/.zshrc: source <(astrolabe completion zsh)
_astrolabe() {
  local line
  local -a words_and_what
  for line in "${(@f)$("${words[1]}" complete -- "${(@)words[2,CURRENT]}" 2>/dev/null)}"; do
    if [[ $line == : ]]; then compset -P '*='; _files
    elif [[ -n $line ]]; then words_and_what+=("${${line//:/\\:}/$'\t'/:}")
    fi
  done
  (( $#words_and_what )) && _describe 'astrolabe' words_and_what
}
if [[ ${funcstack[1]} == _astrolabe ]]; then _astrolabe "$@"; else compdef _astrolabe astrolabe; fi
)";

constexpr const char* kFish = R"(# For ~/.config/fish/completions/astrolabe.fish
function __astrolabe_complete
  set -l typed (commandline -opc) (commandline -ct)
  $typed[1] complete -- $typed[2..-1] 2>/dev/null
end
complete -c astrolabe -f -a '(__astrolabe_complete | string match -v :)'
complete -c astrolabe -n '__astrolabe_complete | string match -q :' -F
)";

struct AboutOptions {
  std::string shell;
  std::filesystem::path folder;
  std::vector<std::string> typed;
};

void print_completion(console::Command app, const std::vector<std::string>& typed) {
  const console::Completion found = console::complete(app, typed);
  for (const auto& [word, what] : found.words) fmt::print("{}\n", what.empty() ? word : word + '\t' + what);
  if (found.files) fmt::print(":\n");
}

}  // namespace

void add_about(console::Command app, const std::string& version) {
  const auto options = std::make_shared<AboutOptions>();
  app.under("About", [&] {
    const console::Command completion =
        app.add_subcommand("completion", "print what makes a shell complete commands, options and files");
    completion.add_option("shell", options->shell, "which shell").required().one_of({"bash", "zsh", "fish"});
    completion.footer(
        "Examples:\n  source <(astrolabe completion bash)\n"
        "  astrolabe completion fish > ~/.config/fish/completions/astrolabe.fish");
    completion.callback([options] {
      fmt::print("{}", options->shell == "bash" ? kBash : options->shell == "zsh" ? kZsh : kFish);
    });
    const console::Command manual =
        app.add_subcommand("manual", "write a man page for each command into a folder");
    manual.add_option("folder", options->folder, "where to write astrolabe.1 and the others").required();
    manual.footer("Examples:\n  astrolabe manual /tmp/man && man /tmp/man/astrolabe-umbmark.1");
    manual.callback([options, app, version] {
      for (const console::ManualPage& page : console::manual_of(app, version)) {
        PartFile file(options->folder / (page.name + ".1"));
        file.write(as_bytes(page.text));
        file.commit();
      }
    });
  });
  app.under("", [&] {  // for the scripts above
    const console::Command complete = app.add_subcommand("complete", "the words that may follow");
    complete.add_option("typed", options->typed, "the words so far; the last is perhaps a beginning");
    complete.callback([options, app] { print_completion(app, options->typed); });
  });
}

}  // namespace astro::commands
