#include "host/formats/cdr/field_reader.hpp"

#include <algorithm>
#include <charconv>

namespace astro::ros2 {
namespace {

using Role = MessageLayout::Role;

constexpr std::size_t kMostNumbers = 1000, kMostElements = 8, kMostPaths = 64;

class NumberList {
 public:
  explicit NumberList(const MessageLayout& layout) : layout_(layout) { add(layout.types.front(), ""); }

  std::vector<NumberField> fields;

 private:
  void add(const MessageLayout::Type& type, const std::string& prefix) {
    for (const MessageLayout::Field& field : type.fields) {
      const bool is_array = field.shape == Shape::array;
      if ((field.shape != Shape::single && !is_array) || field.id == kString) continue;
      for (std::size_t i = 0; i < (is_array ? std::min(field.capacity, kMostElements) : 1); ++i)
        add(field, prefix + field.name + (is_array ? '[' + std::to_string(i) + ']' : ""));
    }
  }
  void add(const MessageLayout::Field& field, const std::string& path) {
    if (fields.size() >= kMostNumbers || ++visited_ > 10 * kMostNumbers) return;
    if (field.id != kNested) {
      fields.push_back({path, field.id});
    } else if (layout_.types[field.type].role == Role::plain) {
      add(layout_.types[field.type], path + '.');
    }
  }

  const MessageLayout& layout_;
  std::size_t visited_ = 0;  // messages may nest without having numbers
};

/// A number as double, whatever its type.
double number_of(CdrReader& in, TypeId id) {
  switch (id) {
    case kInt8:
      return in.number<std::int8_t>();
    case kInt16:
      return in.number<std::int16_t>();
    case kUint16:
      return in.number<std::uint16_t>();
    case kInt32:
      return in.number<std::int32_t>();
    case kUint32:
      return in.number<std::uint32_t>();
    case kInt64:
      return static_cast<double>(in.number<std::int64_t>());
    case kUint64:
      return static_cast<double>(in.number<std::uint64_t>());
    case kFloat32:
      return in.number<float>();
    case kFloat64:
      return in.number<double>();
    default:
      return in.number<std::uint8_t>();
  }
}

void skip_numbers(CdrReader& in, std::size_t size, std::size_t count) {
  switch (size) {
    case 1:
      return in.skip<std::uint8_t>(count);
    case 2:
      return in.skip<std::uint16_t>(count);
    case 4:
      return in.skip<std::uint32_t>(count);
    default:
      return in.skip<std::uint64_t>(count);
  }
}

}  // namespace

std::vector<NumberField> number_fields(const MessageLayout& layout) { return NumberList(layout).fields; }

std::string stamp_field(const MessageLayout& layout) {
  for (const Role role : {Role::header, Role::time})
    for (const MessageLayout::Field& field : layout.types.front().fields)
      if (field.id == kNested && field.shape == Shape::single && layout.types[field.type].role == role)
        return field.name + (role == Role::header ? ".stamp" : "");
  return "";
}

std::optional<NumberField> number_field(const MessageLayout& layout, const std::string& path) {
  const auto reader = FieldReader::of(layout, {path});
  const auto id = reader ? reader->number_type() : std::nullopt;
  return id ? std::optional(NumberField{path, *id}) : std::nullopt;
}

std::optional<TypeId> FieldReader::number_type() const {
  const MessageLayout::Type* type = &layout_.types.front();
  for (const Step& step : paths_.front()) {
    const MessageLayout::Field& field = type->fields[step.field];
    if (field.id != kNested) return field.id;
    type = &layout_.types[field.type];
  }
  return std::nullopt;
}

std::optional<FieldReader> FieldReader::of(const MessageLayout& layout,
                                           const std::vector<std::string>& paths) {
  FieldReader reader;
  for (const std::string& text : paths) {
    auto path = path_in(layout, text);
    if (!path || reader.paths_.size() >= kMostPaths) return std::nullopt;
    reader.paths_.push_back(std::move(*path));
  }
  reader.layout_ = layout;
  return reader;
}

std::optional<FieldReader::Path> FieldReader::path_in(const MessageLayout& layout, std::string_view text) {
  Path path;
  const MessageLayout::Type* type = &layout.types.front();
  while (true) {
    std::string_view word = text.substr(0, text.find('.'));
    const bool last = word.size() == text.size();
    text.remove_prefix(last ? word.size() : word.size() + 1);
    Step step;
    const bool indexed = word.ends_with(']');
    if (indexed) {
      const std::size_t bracket = word.find('[');
      if (bracket == std::string_view::npos) return std::nullopt;
      const char* const end = word.data() + word.size() - 1;
      const auto [stop, error] = std::from_chars(word.data() + bracket + 1, end, step.element);
      if (error != std::errc() || stop != end) return std::nullopt;
      word = word.substr(0, bracket);
    }
    const auto field = std::ranges::find(type->fields, word, &MessageLayout::Field::name);
    if (field == type->fields.end() || indexed == (field->shape == Shape::single) || field->id == kString ||
        (field->shape == Shape::array && step.element >= field->capacity))
      return std::nullopt;
    step.field = static_cast<std::size_t>(field - type->fields.begin());
    path.push_back(step);
    const bool is_value = field->id != kNested || layout.types[field->type].role == Role::time;
    if (last != is_value) return std::nullopt;
    if (last) return path;
    type = &layout.types[field->type];
  }
}

template <class Select>
FieldReader::Mask FieldReader::selected(Mask mask, std::size_t level, const Select& select) const {
  Mask found = 0;
  for (std::size_t i = 0; i < paths_.size(); ++i)
    if ((mask >> i & 1U) != 0 && level < paths_[i].size() && select(paths_[i][level])) found |= Mask{1} << i;
  return found;
}

const std::vector<FieldValue>* FieldReader::read(ByteView message) {
  constexpr std::size_t kMostPadding = 7;
  values_.assign(paths_.size(), {});
  CdrReader in(message);
  this->message(in, layout_.types.front(), ~Mask{0}, 0);
  return in.ok() && in.left() <= kMostPadding ? &values_ : nullptr;
}

void FieldReader::message(CdrReader& in, const MessageLayout::Type& type, Mask mask, std::size_t level) {
  if (type.fields.empty()) in.number<std::uint8_t>();  // "structure_needs_at_least_one_member"
  for (std::size_t i = 0; i < type.fields.size() && in.ok(); ++i)
    field(in, type.fields[i],
          mask == 0 ? 0 : selected(mask, level, [&](const Step& step) { return step.field == i; }), level);
}

void FieldReader::field(CdrReader& in, const MessageLayout::Field& field, Mask mask, std::size_t level) {
  if (field.shape == Shape::single) return value(in, field, mask, level);
  const std::size_t size = bytes_of(field.id);
  const std::size_t count =
      field.shape == Shape::array ? field.capacity : in.length(std::max<std::size_t>(size, 1));
  if (mask == 0 && size > 0) return skip_numbers(in, size, count);
  for (std::size_t i = 0; i < count && in.ok(); ++i)
    value(in, field,
          mask == 0 ? 0 : selected(mask, level, [&](const Step& step) { return step.element == i; }), level);
}

void FieldReader::value(CdrReader& in, const MessageLayout::Field& field, Mask mask, std::size_t level) {
  if (field.id == kString) {
    in.string();
    return;
  }
  FieldValue value;
  if (field.id != kNested) {
    value.number = number_of(in, field.id);
  } else if (const auto& type = layout_.types[field.type]; mask != 0 && type.role == Role::time) {
    value.time_ns = take_time_ns(in);
  } else {
    return message(in, type, mask, level + 1);
  }
  for (std::size_t i = 0; i < paths_.size(); ++i)
    if ((mask >> i & 1U) != 0 && paths_[i].size() == level + 1) values_[i] = value;
}

}  // namespace astro::ros2
