#include "host/formats/cdr/type_hash.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

namespace astro::ros2 {
namespace {

std::string json(const TypeDescription& description) {
  std::string fields;
  for (const auto& [name, type] : description.fields)
    fields += fmt::format(
        R"({}{{"name": "{}", "type": {{"type_id": {}, "capacity": {}, "string_capacity": {}, "nested_type_name": "{}"}}}})",
        fields.empty() ? "" : ", ", name, type.id + static_cast<int>(type.shape), type.capacity,
        type.string_capacity, type.nested);
  return fmt::format(R"({{"type_name": "{}", "fields": [{}]}})", description.name, fields);
}

std::string sha256(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  unsigned size = 0;
  EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr);
  return fmt::format("{:02x}", fmt::join(digest.begin(), digest.begin() + size, ""));
}

}  // namespace

std::string hash_of(const TypeDescription& description) {
  std::string referred;
  for (const auto& [name, each] : description.referred)
    referred += (referred.empty() ? "" : ", ") + json(each);
  return "RIHS01_" + sha256(fmt::format(R"({{"type_description": {}, "referenced_type_descriptions": [{}]}})",
                                        json(description), referred));
}

}  // namespace astro::ros2
