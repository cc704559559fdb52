#pragma once

#include <gmock/gmock.h>

#include <ostream>
#include <string>
#include <vector>

#include "host/base/error.hpp"

/// What a library tells: a fact, and the kind of help. Which words the commands have for that kind is a matter
/// of theirs (tests/host/programs/remedies_test.cpp).
namespace astro {

inline void PrintTo(const Remark& remark, std::ostream* out) {
  *out << '"' << remark.fact << "\", help " << static_cast<int>(remark.remedy.help) << " ("
       << remark.remedy.value << ")";
}

}  // namespace astro

namespace astro::support {

inline Remark remark_of(const Error& error) { return {error.what(), error.remedy()}; }

/// What the astro::Error that `work` throws tells; no fact if it throws none.
template <class Work>
Remark told_by(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return remark_of(error);
  }
  return {};
}

/// Of a Remark: its fact matches, and this would help.
template <class Matcher>
auto Tells(Matcher fact, Help help) {
  return testing::AllOf(
      testing::Field("fact", &Remark::fact, fact),
      testing::Field("remedy", &Remark::remedy, testing::Field("help", &Remedy::help, help)));
}

/// The same with the value that the remedy names.
template <class Matcher>
auto Tells(Matcher fact, Help help, const std::string& value) {
  return testing::AllOf(Tells(fact, help),
                        testing::Field(&Remark::remedy, testing::Field("value", &Remedy::value, value)));
}

/// As testing::ThrowsMessage, with the kind of help.
template <class Matcher, class... Helps>
auto ThrowsTelling(Matcher fact, Helps... help) {
  return testing::Throws<Error>(testing::ResultOf(remark_of, Tells(fact, help...)));
}

}  // namespace astro::support
