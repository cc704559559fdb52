#include "host/commands/base/advice.hpp"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace astro::commands {
namespace {

std::vector<std::span<const Advice>>& known() {
  static std::vector<std::span<const Advice>> tables;
  return tables;
}

const char* words_for(Kind kind) {
  for (const std::span<const Advice> table : known())
    for (const Advice& advice : table)
      if (advice.kind == kind) return advice.words;
  return "";
}

}  // namespace

void advise(std::span<const Advice> all) {
  const auto same = [&](std::span<const Advice> table) { return table.data() == all.data(); };
  if (std::ranges::none_of(known(), same)) known().push_back(all);
}

std::vector<Advice> all_advice() {
  std::vector<Advice> all;
  for (const std::span<const Advice> table : known()) all.insert(all.end(), table.begin(), table.end());
  return all;
}

std::string in_words(const Remark& remark) {
  fmt::dynamic_format_arg_store<fmt::format_context> values;
  for (const std::string& value : remark.values) values.push_back(value);
  if (remark.values.empty()) values.push_back("...");  // stands for {0} if the error has no values
  return remark.sentence + fmt::vformat(words_for(remark.kind), values);
}

std::string in_words(const Error& error) { return in_words(error.remark()); }

}  // namespace astro::commands
