#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/target/image/disassembly.hpp"

namespace astro::target {

/// What no disassembly shows. Functions by their readable names.
struct Pointers {
  /// Where the calls of a function through pointers lead.
  std::map<std::string, std::vector<std::string>> calls;
  /// What the core calls when an interrupt comes, and how urgent that is: smaller is more.
  std::map<std::string, int> handlers;
  /// Entered by the ROM or the core, once, with a stack that begins anew.
  std::set<std::string> beginnings;
};

/// Who calls whom, and what that takes from the stack. Whatever cannot be followed to its end is a problem.
class CallGraph {
 public:
  CallGraph(Program program, Pointers pointers);

  /// The most that `name` and all that it calls can have on the stack. Throws if there is no such function.
  std::uint32_t deepest(const std::string& name);
  /// The way to that depth.
  std::string chain(const std::string& name) const;

  /// The beginning `name`, and on top of it one handler of each urgency, each with what the core stores for
  /// it, and a fault.
  std::uint32_t worst_case(const std::string& name);

  /// What was found on the way, in sentences: recursion, a pointer that may lead anywhere, a function whose
  /// address is taken although nobody is known to go there, an amount of stack that only running shows.
  const std::set<std::string>& problems() const { return problems_; }

 private:
  std::string find(const std::string& readable_name);
  std::uint32_t depth_of(const std::string& name);
  std::uint32_t frame_of(const std::string& name);
  std::set<std::string> callees(const std::string& name);
  void follow_pointers(const std::string& name, std::set<std::string>& names);
  void check_addresses_taken();
  void report_recursion(const std::string& name);

  Program program_;
  Pointers pointers_;
  std::map<std::string, std::string> by_readable_;
  std::map<std::string, std::uint32_t> depth_;
  std::map<std::string, std::string> next_;
  std::vector<std::string> path_;
  std::set<std::string> problems_;
};

/// Bytes that the functions' own code takes, all paths of each together, by linker name. An amount that only
/// running shows counts as none.
std::map<std::string, std::uint32_t> frames(const Program& program);

}  // namespace astro::target
