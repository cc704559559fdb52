#include "host/ros2/types/topic_name.hpp"

namespace astro::ros2 {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool may_follow(char last, char c) {
  if (last == '/') return is_letter(c);
  return c == '/' || is_letter(c) || is_digit(c);
}

}  // namespace

bool is_topic_name(std::string_view name) {
  if (!name.starts_with('/') || name.ends_with('/')) return false;
  for (std::size_t i = 1; i < name.size(); ++i)
    if (!may_follow(name[i - 1], name[i])) return false;
  return true;
}

std::string dds_topic_name(std::string_view topic) { return "rt" + std::string(topic); }

}  // namespace astro::ros2
