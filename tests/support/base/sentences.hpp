#pragma once

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "host/commands/base/remedies.hpp"

/// What a person is told of an error: the library's fact with the remedy that the commands put behind it.
namespace astro::support {

/// The sentence of the astro::Error that `work` throws; "" if it throws none.
template <class Work>
std::string sentence_of(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return commands::in_words(error);
  }
  return "";
}

/// As testing::ThrowsMessage, of the whole sentence.
template <class Matcher>
auto ThrowsSentence(Matcher matcher) {
  return testing::Throws<Error>(
      testing::ResultOf([](const Error& error) { return commands::in_words(error); }, matcher));
}

/// The whole sentences of remarks.
inline std::vector<std::string> sentences_of(const std::vector<Remark>& remarks) {
  std::vector<std::string> sentences;
  for (const Remark& remark : remarks) sentences.push_back(commands::in_words(remark));
  return sentences;
}

}  // namespace astro::support
