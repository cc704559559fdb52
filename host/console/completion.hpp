#pragma once

#include <string>
#include <vector>

#include "host/console/command_line.hpp"

namespace astro::console {

/// What may stand at the end of a command line that is being typed.
struct Completion {
  struct Word {
    std::string word, what;  // what: one line, "" if there is nothing to say

    bool operator==(const Word&) const = default;
  };
  std::vector<Word> words;
  bool files = false;  // the name of a file or folder may stand there, too
};

/// `typed`: the words behind the program's name; the last one may be empty or a beginning.
Completion complete(Command program, const std::vector<std::string>& typed);

}  // namespace astro::console
