#include "host/formats/cdr/ros1.hpp"

#include "host/formats/cdr/cdr.hpp"

namespace astro::ros2 {
namespace {

class Converter {
 public:
  Converter(const MessageLayout& layout, ByteView message)
      : layout_(layout), in_(message), most_bytes_(64 + 8 * message.size()) {}

  std::optional<Bytes> convert() {
    message(layout_.types.front());
    if (!ok() || in_.left() > 0) return std::nullopt;
    return std::move(out_).bytes();
  }

 private:
  using Field = MessageLayout::Field;

  bool ok() const { return in_.ok() && out_.size() <= most_bytes_; }

  void message(const MessageLayout::Type& type) {
    if (type.role == MessageLayout::Role::header) in_.take(sizeof(std::uint32_t));
    if (type.fields.empty()) out_.number(std::uint8_t{0});  // "structure_needs_at_least_one_member"
    for (const Field& each : type.fields)
      if (ok()) field(each);
  }

  void field(const Field& field) {
    std::uint64_t count = field.shape == Shape::array ? field.capacity : 1;
    if (field.shape == Shape::sequence || field.shape == Shape::bounded_sequence) {
      const auto length = in_.number<std::uint32_t>();
      out_.number(length);
      count = length;
    }
    if (const std::size_t size = bytes_of(field.id); size > 0)
      return out_.numbers(in_.take(count * size), size);
    for (std::uint64_t i = 0; i < count && ok(); ++i) {
      if (field.id == kString)
        out_.string(as_text(in_.take(in_.number<std::uint32_t>())));
      else
        message(layout_.types[field.type]);
    }
  }

  const MessageLayout& layout_;
  ByteCursor in_;
  std::size_t most_bytes_;
  CdrWriter out_;
};

}  // namespace

std::optional<Bytes> cdr_from_ros1(const MessageLayout& layout, ByteView message) {
  return Converter(layout, message).convert();
}

}  // namespace astro::ros2
