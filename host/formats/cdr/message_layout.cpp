#include "host/formats/cdr/message_layout.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <utility>

namespace astro::ros2 {
namespace {

constexpr std::size_t kMostFields = 20'000, kMostLevels = 32, kLongestField = 255;
constexpr std::string_view kHeader = "std_msgs/msg/Header", kTime = "builtin_interfaces/msg/Time",
                           kDuration = "builtin_interfaces/msg/Duration", kBlanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

/// The first line, which is cut off `text`.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

bool is_rule(std::string_view line) {
  constexpr std::size_t kLeast = 20;  // writers make 80
  line = trimmed(line);
  return line.size() >= kLeast && line.find_first_not_of('=') == std::string_view::npos;
}

/// "pkg/msg/Type" for "pkg/Type" and for itself.
std::string full_type_name(std::string_view name) {
  const std::size_t first = name.find('/');
  if (first == std::string_view::npos || name.find('/', first + 1) != std::string_view::npos)
    return std::string(name);
  return std::string(name.substr(0, first)) + "/msg" + std::string(name.substr(first));
}

std::string_view package_of(std::string_view name) { return name.substr(0, name.find('/')); }

std::optional<TypeId> primitive(std::string_view name) {
  static const std::map<std::string_view, TypeId> ids = {
      {"bool", kBool},       {"byte", kByte},    {"char", kUint8},    {"int8", kInt8},
      {"uint8", kUint8},     {"int16", kInt16},  {"uint16", kUint16}, {"int32", kInt32},
      {"uint32", kUint32},   {"int64", kInt64},  {"uint64", kUint64}, {"float32", kFloat32},
      {"float64", kFloat64}, {"string", kString}};
  const auto found = ids.find(name);
  return found == ids.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::size_t> count_in(std::string_view digits) {
  constexpr std::size_t kMost = 0xFFFF'FFFF;
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (error != std::errc() || end != digits.data() + digits.size() || count > kMost) return std::nullopt;
  return count;
}

/// The type of a field as it is written: "float64", "geometry_msgs/Point", "uint8[<=4]".
struct WrittenType {
  std::string_view name;
  Shape shape = Shape::single;
  std::size_t capacity = 0;
};

std::optional<WrittenType> written_type(std::string_view text) {
  WrittenType type;
  const std::size_t bracket = text.find('[');
  // A bounded string has the bytes of any other.
  type.name = text.substr(0, std::min(bracket, text.find("<=")));
  if (bracket == std::string_view::npos) return type;
  if (text.back() != ']') return std::nullopt;
  std::string_view size = text.substr(bracket + 1, text.size() - bracket - 2);
  type.shape = size.empty()             ? Shape::sequence
               : size.starts_with("<=") ? Shape::bounded_sequence
                                        : Shape::array;
  if (size.empty()) return type;
  if (type.shape == Shape::bounded_sequence) size.remove_prefix(2);
  const auto count = count_in(size);
  if (!count || *count == 0) return std::nullopt;
  type.capacity = type.shape == Shape::array ? *count : 0;
  return type;
}

class Parser {
 public:
  Parser(std::string_view name, std::string_view text, DefinitionFormat format) : format_(format) {
    std::string section(name);
    while (!text.empty()) {
      std::string_view rest = text;
      std::size_t length = 0;
      while (!rest.empty() && !is_rule(rest.substr(0, rest.find('\n')))) {
        next_line(rest);
        length = text.size() - rest.size();
      }
      sections_.emplace(std::move(section), text.substr(0, length));
      next_line(rest);
      const std::string_view title = trimmed(next_line(rest));
      constexpr std::string_view kMsg = "MSG: ";
      section = title.starts_with(kMsg) ? full_type_name(trimmed(title.substr(kMsg.size()))) : std::string();
      text = rest;
    }
    if (!section.empty()) sections_.emplace(std::move(section), text);  // a message without fields
  }

  std::optional<MessageLayout> parse(const std::string& name) {
    if (!add(name, 0)) return std::nullopt;
    return std::move(layout_);
  }

 private:
  /// The index of the type; nothing if it cannot be laid out.
  std::optional<std::size_t> add(const std::string& name, std::size_t level) {
    if (const auto known = indices_.find(name); known != indices_.end()) return known->second;
    if (level >= kMostLevels) return std::nullopt;
    const std::size_t index = layout_.types.size();
    layout_.types.push_back({name, MessageLayout::Role::plain, {}});
    // A message that contains itself finds nothing here while it is being laid out.
    indices_[name] = std::nullopt;
    if (!add_known(index, level) && !add_section(index, level)) return std::nullopt;
    indices_[name] = index;
    return index;
  }

  bool add_known(std::size_t index, std::size_t level) {
    const std::string name = layout_.types[index].name;
    if (name == kTime || name == kDuration) {
      layout_.types[index].role = name == kTime ? MessageLayout::Role::time : MessageLayout::Role::plain;
      layout_.types[index].fields = {{"sec", kInt32}, {"nanosec", kUint32}};
      return true;
    }
    if (name != kHeader) return false;
    const auto time = add(std::string(kTime), level + 1);
    if (!time) return false;
    layout_.types[index].role = MessageLayout::Role::header;
    layout_.types[index].fields = {{"stamp", kNested, Shape::single, 0, *time}, {"frame_id", kString}};
    return true;
  }

  bool add_section(std::size_t index, std::size_t level) {
    const auto section = sections_.find(layout_.types[index].name);
    if (section == sections_.end()) return false;
    for (std::string_view rest = section->second; !rest.empty();)
      if (!add_line(next_line(rest), index, level)) return false;
    return true;
  }

  /// A line of a definition: a field, a constant, or nothing but a comment.
  bool add_line(std::string_view line, std::size_t index, std::size_t level) {
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) return true;
    const std::size_t blank = line.find_first_of(kBlanks);
    if (blank == std::string_view::npos) return false;
    const auto written = written_type(line.substr(0, blank));
    const std::string_view rest = trimmed(line.substr(blank));
    const std::size_t end =
        std::min(rest.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_"),
                 rest.size());
    const std::string_view name = rest.substr(0, end);
    if (!written || name.empty() || name.size() > kLongestField) return false;
    if (trimmed(rest.substr(end)).starts_with('=')) return true;
    if (!fields_.emplace(index, name).second || fields_.size() > kMostFields) return false;
    MessageLayout::Field field{std::string(name), kNested, written->shape, written->capacity, 0};
    if (const auto id = primitive(written->name)) {
      field.id = *id;
    } else {
      const auto type = add(nested_name(written->name, package_of(layout_.types[index].name)), level + 1);
      if (!type) return false;
      field.type = *type;
    }
    layout_.types[index].fields.push_back(std::move(field));
    return true;
  }

  std::string nested_name(std::string_view written, std::string_view package) const {
    if (format_ == DefinitionFormat::ros1msg && written == "time") return std::string(kTime);
    if (format_ == DefinitionFormat::ros1msg && written == "duration") return std::string(kDuration);
    if (written.find('/') != std::string_view::npos) return full_type_name(written);
    const std::string beside = std::string(package) + "/msg/" + std::string(written);
    return written == "Header" && !sections_.contains(beside) ? std::string(kHeader) : beside;
  }

  DefinitionFormat format_;
  std::map<std::string, std::string_view> sections_;  // by the names of the types
  std::map<std::string, std::optional<std::size_t>> indices_;
  std::set<std::pair<std::size_t, std::string_view>> fields_;  // by type; none may be there twice
  MessageLayout layout_;
};

}  // namespace

std::optional<MessageLayout> parse_definition(std::string_view name, std::string_view text,
                                              DefinitionFormat format) {
  if (text.empty() && format == DefinitionFormat::ros2msg) return std::nullopt;
  const std::string full = full_type_name(name);
  return Parser(full, text, format).parse(full);
}

std::string ros2_type_name(std::string_view ros1_name) {
  return ros1_name == "tf/tfMessage" ? "tf2_msgs/msg/TFMessage" : full_type_name(ros1_name);
}

std::size_t bytes_of(TypeId id) {
  switch (id) {
    case kInt8:
    case kUint8:
    case kBool:
    case kByte:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kInt32:
    case kUint32:
    case kFloat32:
      return 4;
    case kInt64:
    case kUint64:
    case kFloat64:
      return 8;
    default:
      return 0;
  }
}

}  // namespace astro::ros2
