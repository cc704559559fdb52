#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.hpp"

/// Which of the bodies in a recording is meant.
namespace astro::truth {

struct BodyName {
  std::string name, id;  // id "" where the format has none
  bool operator==(const BodyName&) const = default;
};

/// Which body is meant is not known. Values: the file, and the name or id that was asked for.
enum class BodyProblem { unknown };

/// The body asked for is not in the recording, or several could be meant.
class UnknownBody : public Error {
 public:
  UnknownBody(const std::string& sentence, std::string_view file, std::string_view wanted,
              std::vector<BodyName> bodies)
      : Error(sentence, BodyProblem::unknown, {std::string(file), std::string(wanted)}),
        bodies_(std::move(bodies)) {}
  /// All that the recording holds.
  const std::vector<BodyName>& bodies() const { return bodies_; }

 private:
  std::vector<BodyName> bodies_;
};

/// The index of the body whose name or id is `wanted`. If `wanted` is empty, it is that of the only body, or of the only one
/// without a name. Throws UnknownBody. Precondition: `bodies` is not empty.
std::size_t choose_body(const std::vector<BodyName>& bodies, std::string_view wanted, std::string_view file);

}  // namespace astro::truth
