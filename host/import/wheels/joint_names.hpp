#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/side.hpp"

namespace astro::importing {

struct JointPair {
  std::string left, right;

  bool operator==(const JointPair&) const = default;
};

/// The words of a name in lower case: "leftWheel_joint1" has left, wheel, joint and 1.
std::vector<std::string> words_of(std::string_view name);

/// A name, and its words with a placeholder for that of its side: "<> wheel " for "left_wheel", "<>wheel "
/// for "lwheel". `side` is empty if there is no such word, or more than one, or
/// one that names an axle with a letter.
struct SidedName {
  std::optional<Side> side;
  std::string stem;
};

SidedName sided_name(std::string_view name);

/// The side that a word names, and what else it says: left and "" for "left" and "l", "wheel" for "leftwheel" and "lwheel", "f"
/// for "fl". In "rr" and "rl" of rear wheels the last letter counts. Nothing if it names none. The words are English, or those of
/// the languages in which tables have columns of times (host/formats/tables/time_column.hpp).
struct SidedWord {
  Side side;
  std::string rest;
  bool is_letter = false;  // one that counts only where no word of the name is spelled out: "mr_left" is left
};
std::optional<SidedWord> sided_word(const std::string& word);

/// What each word of a name says of the side, with the letters left out where they do not count.
std::vector<std::optional<SidedWord>> sided_words(std::span<const std::string> words);

/// Whether the words say that this is no travel or speed that was measured: commands, limits, currents, temperatures.
bool is_of_no_use(std::span<const std::string> words);

/// Whether one of the words is about wheels or what drives them.
bool speaks_of_wheels(std::string_view words);

/// Finds the joints of the driven wheels: the one pair whose names differ only in the word for the side (left
/// and right, l and r, port and starboard). If there are several pairs, it is the one whose names contain a
/// word such as wheel, tyre, tire, drive or motor. Nothing if no pair or more than one remains.
std::optional<JointPair> recognise_wheels(std::span<const std::string> names);

}  // namespace astro::importing
