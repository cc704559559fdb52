#include "tests/target/image/call_graph.hpp"

#include <algorithm>
#include <stdexcept>

#include "tests/target/image/binutils.hpp"

namespace astro::target {
namespace {

/// The core stores eight registers, and a word more if the stack is not aligned to eight.
constexpr std::uint32_t kExceptionFrame = 32 + 4;

/// The linker puts one in where a branch does not reach, and calls it __TARGET_veneer.
bool is_veneer(const std::string& name) { return name.starts_with("__") && name.ends_with("_veneer"); }

std::string veneer_target(const std::string& name) {
  return name.substr(2, name.size() - 2 - std::string("_veneer").size());
}

}  // namespace

CallGraph::CallGraph(Program program, Pointers pointers)
    : program_(std::move(program)), pointers_(std::move(pointers)) {
  for (const auto& [name, function] : program_.functions) by_readable_.emplace(readable(name), name);
  check_addresses_taken();
}

std::string CallGraph::find(const std::string& readable_name) {
  const auto found = by_readable_.find(readable_name);
  if (found != by_readable_.end()) return found->second;
  problems_.insert(readable_name + " is listed in pointers.hpp, and not in the image");
  return "";
}

void CallGraph::check_addresses_taken() {
  std::set<std::string> known = pointers_.beginnings;
  for (const auto& [handler, urgency] : pointers_.handlers) known.insert(handler);
  for (const auto& [caller, targets] : pointers_.calls) known.insert(targets.begin(), targets.end());
  for (const std::string& name : program_.addresses_taken)
    if (!known.contains(readable(name)))
      problems_.insert(readable(name) +
                       " has its address taken, and pointers.hpp does not say who goes there");
}

std::uint32_t CallGraph::frame_of(const std::string& name) {
  std::uint32_t bytes = 0;
  for (const Instruction& i : program_.functions.at(name).instructions) {
    const auto taken = i.stack_bytes();
    if (!taken && !pointers_.beginnings.contains(readable(name)))
      problems_.insert(readable(name) + " takes an amount of stack that only running shows: " + i.mnemonic +
                       " " + i.operands);
    bytes += taken.value_or(0);
  }
  return bytes;
}

void CallGraph::follow_pointers(const std::string& name, std::set<std::string>& names) {
  const auto listed = pointers_.calls.find(readable(name));
  if (listed == pointers_.calls.end()) {
    problems_.insert(readable(name) + " calls through a pointer, and pointers.hpp does not say whom");
    return;
  }
  for (const std::string& target : listed->second)
    if (const std::string found = find(target); !found.empty()) names.insert(found);
}

std::set<std::string> CallGraph::callees(const std::string& name) {
  if (is_veneer(name)) return {veneer_target(name)};
  const std::vector<Instruction>& code = program_.functions.at(name).instructions;
  std::set<std::string> names;
  bool pointer = false;
  for (const Instruction& i : code) {
    const std::string target = i.branch_target();
    pointer = pointer || i.goes_through_pointer();
    // A call of itself is one; a jump within itself is none.
    if (!target.empty() && (target != name || i.calls())) names.insert(target);
    if (target != name && i.branches_into_the_middle())
      problems_.insert(readable(name) + " branches into the middle of " + readable(target));
  }
  if (pointer) follow_pointers(name, names);
  const auto last = std::find_if(code.rbegin(), code.rend(), [](const Instruction& i) { return !i.fills(); });
  if (last != code.rend() && !last->ends_a_path())
    problems_.insert(readable(name) + " runs on into what follows it: " + last->mnemonic);
  return names;
}

void CallGraph::report_recursion(const std::string& name) {
  std::string cycle;
  for (auto it = std::find(path_.begin(), path_.end(), name); it != path_.end(); ++it)
    cycle += readable(*it) + " -> ";
  problems_.insert("recursion: " + cycle + readable(name));
}

std::uint32_t CallGraph::depth_of(const std::string& name) {
  if (const auto known = depth_.find(name); known != depth_.end()) return known->second;
  if (std::find(path_.begin(), path_.end(), name) != path_.end()) {
    report_recursion(name);
    return 0;
  }
  if (!program_.functions.contains(name)) {
    problems_.insert(readable(name) + " is called, and its code was not found");
    return 0;
  }
  path_.push_back(name);
  std::uint32_t below = 0;
  for (const std::string& callee : callees(name))
    if (const std::uint32_t depth = depth_of(callee); depth > below || !next_.contains(name)) {
      below = std::max(below, depth);
      next_[name] = callee;
    }
  path_.pop_back();
  return depth_[name] = below + frame_of(name);
}

std::uint32_t CallGraph::deepest(const std::string& name) {
  const std::string found = find(name);
  if (found.empty()) throw std::runtime_error(name + " is not in the image");
  return depth_of(found);
}

std::string CallGraph::chain(const std::string& name) const {
  std::string at = by_readable_.at(name), text = name;
  while (next_.contains(at) && text.size() < 2000) text += " -> " + readable(at = next_.at(at));
  return text;
}

std::uint32_t CallGraph::worst_case(const std::string& name) {
  std::map<int, std::uint32_t> levels;
  for (const auto& [handler, urgency] : pointers_.handlers)
    levels[urgency] = std::max(levels[urgency], deepest(handler) + kExceptionFrame);
  std::uint32_t bytes = deepest(name) + kExceptionFrame;
  for (const auto& [urgency, depth] : levels) bytes += depth;
  return bytes;
}

std::map<std::string, std::uint32_t> frames(const Program& program) {
  std::map<std::string, std::uint32_t> bytes;
  for (const auto& [name, function] : program.functions)
    for (const Instruction& i : function.instructions) bytes[name] += i.stack_bytes().value_or(0);
  return bytes;
}

}  // namespace astro::target
