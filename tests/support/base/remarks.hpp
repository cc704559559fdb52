#pragma once

#include <gmock/gmock.h>

#include <ostream>
#include <string>
#include <vector>

#include "host/base/error.hpp"

/// What a library tells: the kind, and the names and values in its sentence. How the sentence reads is tested where a command
/// prints it.
namespace astro {

inline void PrintTo(const Remark& remark, std::ostream* out) {
  *out << '"' << remark.sentence << '"';
  for (const std::string& value : remark.values) *out << " [" << value << "]";
}

}  // namespace astro

namespace astro::support {

/// What the astro::Error that `work` throws tells; no sentence if it throws none.
template <class Work>
Remark told_by(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return error.remark();
  }
  return {};
}

/// Of a Remark: it is of this kind.
inline auto Tells(Kind kind) { return testing::Field("kind", &Remark::kind, kind); }

/// The same with these values, in their order: strings or matchers of strings.
template <class... Values>
auto Tells(Kind kind, Values... values) {
  return testing::AllOf(Tells(kind),
                        testing::Field("values", &Remark::values, testing::ElementsAre(values...)));
}

/// Of something that is called: it throws an astro::Error of this kind, with these values if any are given.
/// ThrowsTelling<LinkLost>(...): and of this class.
template <class Thrown = Error, class... Values>
auto ThrowsTelling(Kind kind, Values... values) {
  return testing::Throws<Thrown>(
      testing::ResultOf([](const Error& error) { return error.remark(); }, Tells(kind, values...)));
}

}  // namespace astro::support
