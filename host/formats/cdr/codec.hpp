#pragma once

#include <optional>

#include "host/formats/cdr/cdr.hpp"
#include "host/formats/cdr/message.hpp"

/// Messages to bytes and back, by their lists of fields.
namespace astro::ros2 {

/// The fewest bytes that a value takes, by which a claimed length of a sequence is judged.
template <class T>
constexpr std::size_t least_bytes() {
  if constexpr (Message<T>) {
    const std::size_t sum = std::apply(
        [](const auto&... field) {
          return (std::size_t{0} + ... +
                  least_bytes<std::remove_cvref_t<decltype(std::declval<T>().*field.member)>>());
        },
        T::kFields);
    return sum == 0 ? 1 : sum;
  } else if constexpr (IsArray<T>::value) {
    return std::tuple_size_v<T> * least_bytes<typename T::value_type>();
  } else if constexpr (Number<T> || std::is_same_v<T, std::byte>) {
    return sizeof(T);
  } else {
    return sizeof(std::uint32_t);  // a length
  }
}

template <class T>
void put(CdrWriter& out, const T& value);

template <Message M>
void put_fields(CdrWriter& out, const M& message) {
  if constexpr (kIsEmpty<M>)
    out.number(std::uint8_t{0});  // "structure_needs_at_least_one_member"
  else
    for_each_field(message, [&](std::string_view, const auto& field) { put(out, field); });
}

/// Whether elements stand in memory as in a message, so that all are copied at once. vector<bool> has no elements in memory.
template <class T>
inline constexpr bool kIsPlainNumber = Number<T> && !std::is_same_v<T, bool>;

template <class List>
void put_each(CdrWriter& out, const List& list) {
  using T = typename List::value_type;
  if constexpr (kIsPlainNumber<T>)
    out.numbers({reinterpret_cast<const std::uint8_t*>(list.data()), list.size() * sizeof(T)}, sizeof(T));
  else
    for (const auto& each : list) put(out, each);
}

template <class T>
void put(CdrWriter& out, const T& value) {
  if constexpr (Message<T>) {
    put_fields(out, value);
  } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::byte>) {
    out.number(static_cast<std::uint8_t>(value));
  } else if constexpr (Number<T>) {
    out.number(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    out.string(value);
  } else if constexpr (IsBoundedText<T>::value) {
    out.string(value.text);
  } else if constexpr (IsArray<T>::value) {
    put_each(out, value);
  } else if constexpr (IsOptional<T>::value) {
    out.number(static_cast<std::uint32_t>(value.has_value()));
    if (value) put(out, *value);
  } else {
    out.number(static_cast<std::uint32_t>(value.size()));
    put_each(out, value);
  }
}

template <class T>
void take(CdrReader& in, T& value);

template <class T>
void take_sequence(CdrReader& in, std::vector<T>& list) {
  const std::size_t length = in.length(least_bytes<T>());
  list.clear();
  if constexpr (kIsPlainNumber<T>) {
    list.resize(length);
    in.numbers(std::span<T>(list));
    return;
  }
  list.reserve(length);
  for (std::size_t i = 0; i < length && in.ok(); ++i) {
    T each{};
    take(in, each);
    list.push_back(std::move(each));
  }
}

template <class T>
void take_optional(CdrReader& in, std::optional<T>& value) {
  value.reset();
  const auto length = in.number<std::uint32_t>();
  if (length > 1) return in.refuse();
  if (length == 1) take(in, value.emplace());
}

template <class T>
void take(CdrReader& in, T& value) {
  if constexpr (Message<T>) {
    if constexpr (kIsEmpty<T>) {
      if (in.left() > 0) in.number<std::uint8_t>();  // there are writers that leave the byte out
    } else {
      for_each_field(value, [&](std::string_view, auto& field) { take(in, field); });
    }
  } else if constexpr (std::is_same_v<T, bool>) {
    value = in.number<std::uint8_t>() != 0;
  } else if constexpr (std::is_same_v<T, std::byte>) {
    value = static_cast<std::byte>(in.number<std::uint8_t>());
  } else if constexpr (Number<T>) {
    value = in.number<T>();
  } else if constexpr (std::is_same_v<T, std::string>) {
    value = in.string();
  } else if constexpr (IsBoundedText<T>::value) {
    value.text = in.string();
    if (value.text.size() > IsBoundedText<T>::kMost) in.refuse();
  } else if constexpr (IsArray<T>::value) {
    if constexpr (kIsPlainNumber<typename T::value_type>)
      in.numbers(std::span<typename T::value_type>(value));
    else
      for (auto& each : value) take(in, each);
  } else if constexpr (IsOptional<T>::value) {
    take_optional(in, value);
  } else {
    take_sequence(in, value);
  }
}

template <Message M>
Bytes encode(const M& message) {
  CdrWriter out;
  put(out, message);
  return std::move(out).bytes();
}

/// Nothing if the bytes are too short for the type, or hold a string or a sequence that does not fit it. In memory a message
/// takes at most some ten times its bytes.
template <Message M>
std::optional<M> decode(ByteView bytes) {
  CdrReader in(bytes);
  M message;
  take(in, message);
  if (!in.ok()) return std::nullopt;
  return message;
}

}  // namespace astro::ros2
