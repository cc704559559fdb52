#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace astro {

/// The kind of a problem: a value of an enumeration that belongs to the room which reports it, for instance
/// importing::WheelProblem::columns_unclear. So a new kind changes only that room.
class Kind {
 public:
  constexpr Kind() = default;
  template <typename Problem>
  requires std::is_enum_v<Problem>
  constexpr Kind(Problem problem)  // NOLINT(google-explicit-constructor): a problem is a kind
      : room_(&kRoom<Problem>), problem_(static_cast<int>(problem)) {}

  friend constexpr bool operator==(const Kind&, const Kind&) = default;

 private:
  template <typename Problem>
  static constexpr char kRoom = 0;  // its address tells the enumerations apart

  const char* room_ = nullptr;
  int problem_ = 0;
};

/// A notice that is not an error. It is a whole sentence, with the remedy if that needs no command line. The kind, and the
/// names and values in the sentence, are for callers that act on it or know an option that helps
/// (host/commands/base/advice.hpp).
struct Remark {
  std::string sentence;
  Kind kind = {};
  std::vector<std::string> values = {};

  /// The same in a sentence that begins with `where`: "run 3: ".
  Remark in(const std::string& where) const { return {where + sentence, kind, values}; }
};

/// What the host tools throw when something outside the program is wrong.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& sentence, Kind kind = {}, std::vector<std::string> values = {})
      : std::runtime_error(sentence), kind_(kind), values_(std::move(values)) {}
  explicit Error(const Remark& remark) : Error(remark.sentence, remark.kind, remark.values) {}

  Kind kind() const { return kind_; }
  const std::vector<std::string>& values() const { return values_; }
  Remark remark() const { return {what(), kind_, values_}; }

  Remark in(const std::string& where) const { return remark().in(where); }

 private:
  Kind kind_;
  std::vector<std::string> values_;
};

}  // namespace astro
