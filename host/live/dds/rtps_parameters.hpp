#pragma once

#include <bit>
#include <optional>

#include "host/base/bytes.hpp"

namespace astro::dds {

/// How many bytes the parameter list at the head of `bytes` takes, its sentinel included; nothing if it is malformed: it has
/// no sentinel, a parameter ends outside `bytes` or where no parameter can begin, or one that the standard defines is too
/// short for its value, or holds a text or sequence that ends outside it. Only the length is checked of vendors' parameters.
///
/// Source  DDSI-RTPS 2.2, 9.4.2.11 and 9.6.2.2.
std::optional<std::size_t> parameter_list_size(ByteView bytes, std::endian order);

/// Whether the payload of discovery data is a parameter list and nothing after it.
bool is_parameter_list_payload(ByteView payload);

}  // namespace astro::dds
