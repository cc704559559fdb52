#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/formats/cdr/cdr.hpp"
#include "host/formats/cdr/message_layout.hpp"

namespace astro::ros2 {

/// A field that is a number, by the names that lead to it: "left_encoder", "position[2]",
/// "pose.pose.position.x".
struct NumberField {
  std::string path;
  TypeId id = kFloat64;

  bool is_integer() const { return id != kFloat32 && id != kFloat64; }
};

/// The numbers of a message in their order, at most 1000 of them: those in times and in sequences are left
/// out, and of a fixed array the first eight are taken.
std::vector<NumberField> number_fields(const MessageLayout& layout);

/// The number to which a path leads, also an element of a sequence; nothing if it leads to a time, or to no number.
std::optional<NumberField> number_field(const MessageLayout& layout, const std::string& path);

/// The path of the time at which the publisher says that the message was true: of its first header, or else
/// of a time of its own. "" if it has none.
std::string stamp_field(const MessageLayout& layout);

struct FieldValue {
  double number = std::numeric_limits<double>::quiet_NaN();  // NaN if a sequence is too short to have it
  std::int64_t time_ns = 0;                                  // of a field that is a time
};

/// Reads a few fields of the messages of one layout.
class FieldReader {
 public:
  /// Nothing if a path leads to no number and no time, or if there are more than 64 of them. An element of a
  /// sequence needs its index.
  static std::optional<FieldReader> of(const MessageLayout& layout, const std::vector<std::string>& paths);

  /// The values of the paths in their order; valid until the next call. Null if the message (CDR, in either
  /// byte order) does not fit the layout, or has more than padding behind it.
  const std::vector<FieldValue>* read(ByteView message);

  /// The type of the number to which the only path leads; nothing if it leads to a time.
  std::optional<TypeId> number_type() const;

 private:
  struct Step {
    std::size_t field = 0, element = 0;
  };
  using Path = std::vector<Step>;
  using Mask = std::uint64_t;  // of the paths that lead to where the reader is

  static std::optional<Path> path_in(const MessageLayout& layout, std::string_view text);
  void message(CdrReader& in, const MessageLayout::Type& type, Mask mask, std::size_t level);
  void field(CdrReader& in, const MessageLayout::Field& field, Mask mask, std::size_t level);
  void value(CdrReader& in, const MessageLayout::Field& field, Mask mask, std::size_t level);
  template <class Select>
  Mask selected(Mask mask, std::size_t level, const Select& select) const;

  MessageLayout layout_;
  std::vector<Path> paths_;
  std::vector<FieldValue> values_;
};

}  // namespace astro::ros2
