#include "tests/common/protocol/readme_text.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <type_traits>

#include "common/protocol/frame.hpp"
#include "common/protocol/messages.hpp"
#include "tests/common/protocol/enum_name.hpp"

namespace astro::protocol {
namespace {

constexpr std::string_view kBegin = "<!-- generated from the schema: begin -->\n";
constexpr std::string_view kEnd = "<!-- generated from the schema: end -->\n";

template <std::integral T>
std::string type_text(T*) {
  return (std::is_signed_v<T> ? "i" : "u") + std::to_string(8 * sizeof(T));
}
template <Named E>
std::string type_text(E*) {
  static_assert(!enum_name<E>().empty(), "name this enumeration above");
  return type_text(static_cast<std::underlying_type_t<E>*>(nullptr)) + " " + std::string(enum_name<E>());
}
template <std::size_t N>
std::string type_text(std::array<std::uint8_t, N>*) {
  return "u8[" + std::to_string(N) + "]";
}
template <std::size_t N>
std::string type_text(Text<N>*) {
  return "text[" + std::to_string(N) + "]";
}

std::string hex(std::uint8_t byte) {
  std::array<char, 5> digits{};
  std::snprintf(digits.data(), digits.size(), "0x%02X", byte);
  return digits.data();
}

std::string row(std::initializer_list<std::string> cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += (cell.empty() ? "" : " ") + cell + " |";
  return line + "\n";
}

/// Rows of a record's fields from byte `offset` on; groups inside `M` have tables of their own.
template <class M>
std::string field_rows(std::size_t offset) {
  std::string rows = row({"offset", "type", "name", "unit", ""}) + "|---|---|---|---|---|\n";
  detail::each<false, M>([&]<class F>(const F& field) {
    using Value = typename F::Value;
    rows += row({std::to_string(offset), type_text(static_cast<Value*>(nullptr)), std::string(field.name),
                 std::string(field.unit), std::string(field.doc)});
    offset += detail::Wire<Value>::kSize;
  });
  return rows + "\n";
}

template <class M>
std::string group_tables() {
  std::string text;
  detail::each<true, M>([&]<class G>(const G& group) {
    text += "Bit " + std::to_string(group.bit) + ", `" + std::string(group.name) +
            "`: " + std::string(group.doc) + ". Offsets from the start of the group.\n\n" +
            field_rows<typename G::Value>(0);
  });
  return text;
}

template <Message M>
std::string message_text() {
  std::string text = "### " + hex(M::kId) + " " + std::string(M::kName) + "\n\n" + std::string(M::kDoc);
  if constexpr (Request<M>) text += " Reply: " + std::string(M::Reply::kName) + ".";
  text += " Body: " + std::string(detail::group_mask<M>() != 0 ? "at most " : "") +
          std::to_string(kBodySize<M>) + " bytes.\n\n";
  if constexpr (std::tuple_size_v<std::remove_cvref_t<decltype(M::kFields)>> != 0) {
    text += field_rows<M>(kHeaderSize);
  }
  return text + group_tables<M>();
}

template <Named E>
std::string enum_row() {
  std::string values;
  for (std::size_t i = 0; i < names(E{}).size(); ++i) {
    values += (i == 0 ? "" : ", ") + std::to_string(i) + " " + std::string(names(E{})[i]);
  }
  return row({std::string(enum_name<E>()), values});
}

std::string enum_tables() {
  std::string text = "## Enumerations\n\n| enumeration | values |\n|---|---|\n" + enum_row<Mode>() +
                     enum_row<SegmentKind>() + enum_row<SegmentOutcome>() + enum_row<ParameterKind>() +
                     enum_row<ResetCause>() + enum_row<Fault>() + enum_row<GyroState>() +
                     "\n| ErrorCode | | meaning |\n|---|---|---|\n";
  for (std::size_t i = 0; i < kErrorCodeNames.size(); ++i) {
    text += row({std::to_string(i), std::string(kErrorCodeNames[i]), std::string(kErrorCodeMeanings[i])});
  }
  return text + "\n";
}

std::string bytes_text(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += (text.empty() ? "" : " ") + hex(byte).substr(2);
  return text;
}

std::string example() {
  const Velocity message{.v_umps = 250'000, .omega_uradps = -1};
  std::array<std::uint8_t, kMaxBody> body{};
  const std::size_t size = encode(message, 7, body);
  return "## Example\n\nVelocity{v_umps = 250000, omega_uradps = -1} as request 7:\n\n    body   " +
         bytes_text(std::span(body).first(size)) + "\n    frame  " + bytes_text(Frame(message, 7).bytes()) +
         "\n\n";
}

template <class List>
std::string section(std::string_view title) {
  std::string text = "## " + std::string(title) + "\n\n";
  List::visit([&]<Message M>() { text += message_text<M>(); });
  return text;
}

}  // namespace

std::string generated_part() {
  return "\nProtocol version " + std::to_string(kProtocolVersion) + ".\n\n" + example() + enum_tables() +
         section<Requests>("Requests") + section<Replies>("Replies") + section<Events>("Events");
}

std::string with_generated_part(std::string_view readme) {
  const std::size_t begin = readme.find(kBegin);
  const std::size_t end = readme.find(kEnd);
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) return "";
  return std::string(readme.substr(0, begin + kBegin.size())) + generated_part() +
         std::string(readme.substr(end));
}

}  // namespace astro::protocol
