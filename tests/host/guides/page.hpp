#pragma once

#include <string>
#include <vector>

/// The commands of a page of Markdown, with what it shows of their output.
namespace astro::guides {

/// In a block of code (four blanks) a command begins at the block's own margin and goes on after a backslash at the end of a
/// line. Lines two columns further in are lines of its output. A block between fences ("```python NAME") is a file that the reader
/// writes, which is a command, too: cat > NAME.
struct Command {
  int line = 0;  // of the page, from 1
  std::string text;
  std::vector<std::string> shown;

  /// Whether it is one of this program; others are programs of the reader's computer.
  bool is_ours() const { return text.starts_with("astrolabe "); }
};

std::vector<Command> commands_of(const std::string& page);

/// The first line of `shown` that `output` does not have behind those before it; "" if it has them all. "..." in a line stands for
/// any text, and blanks for any number of blanks. A number stands for one that differs by at most a quarter or two of its last
/// digits: drives slip anew wherever commands reach the robot at other ticks.
std::string missing_line(const std::vector<std::string>& shown, const std::string& output);

}  // namespace astro::guides
