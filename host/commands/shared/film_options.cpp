#include "host/commands/shared/film_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/base/text/numbers.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/options.hpp"
#include "host/film/track/figure_doubts.hpp"
#include "host/truth/source/reading.hpp"

namespace astro::commands {
namespace {

std::optional<double> length_in(const std::string& text, double least_m, double most_m) {
  const auto length = truth::length_m_in(text, truth::LengthUnit::m);
  if (!length || *length < least_m || *length > most_m) return std::nullopt;
  return length;
}

console::Check a_length(double least_m, double most_m) {
  return [=](const std::string& word) -> std::string {
    if (length_in(word, least_m, most_m)) return "";
    return fmt::format("'{}' is not a length from {} to {} m: write 120mm, 12cm or 0.12", word, least_m,
                       most_m);
  };
}

constexpr double kShortest_m = 0.1, kLongest_m = 100;

/// "1:4=3.46": the distance between the centres of floor tags 1 and 4.
std::optional<film::FilmFigures::Length> tape_in(const std::string& text) {
  const std::size_t colon = text.find(':'), sign = text.find('=');
  if (colon == std::string::npos || sign == std::string::npos || sign < colon) return std::nullopt;
  const auto from = typed_number(text.substr(0, colon)),
             to = typed_number(text.substr(colon + 1, sign - colon - 1));
  const auto length = length_in(text.substr(sign + 1), kShortest_m, kLongest_m);
  const auto is_id = [](const std::optional<double>& id) {
    return id && *id >= 0 && *id <= 586 && *id == static_cast<int>(*id);
  };
  if (!is_id(from) || !is_id(to) || *from == *to || !length) return std::nullopt;
  return film::FilmFigures::Length{static_cast<int>(*from), static_cast<int>(*to), *length};
}

constexpr Advice kFilmAdvice[] = {
    {film::FilmProblem::distance_to_robot, ": correct --tape {0}=..., or leave it out"},
    {film::FilmProblem::distance_to_unseen_tag, ": correct --tape {0}=..., or leave it out"},
    {film::FilmProblem::other_tag_moves, ": if that is on the robot, give --robot-tag {0}"},
    {film::FilmProblem::no_distance,
     "; measure one, best from the centre of one floor tag to that of another three metres away, and give it "
     "with --tape"},
    {film::FilmProblem::no_height, ": measure it and give it with --tag-height"},
    {film::FilmProblem::unusual_height, ": measure it and give it with --tag-height"},
};

}  // namespace

void add_film_options(console::Command command, FilmOptions& options, const std::string& prefix) {
  advise(kFilmAdvice);
  command.add_option("--robot-tag", options.robot_tag, prefix + "the number of the robot's tag (tag36h11)")
      .type_name("ID")
      .check(console::whole(0, 586))
      .capture_default_str();
  command
      .add_option("--tag-side", options.tag_side,
                  prefix + "side of the black square of the robot's\ntag, as 120.1mm")
      .type_name("LENGTH")
      .check(a_length(0.02, 2));
  command.add_option("--tag-height", options.tag_height, prefix + "of the robot's tag above the floor")
      .type_name("LENGTH")
      .check(a_length(0, 3));
  command
      .add_option("--floor-tag-side", options.floor_tag_side,
                  prefix + "side of the black squares of the tags\non the floor, which are all alike")
      .type_name("LENGTH")
      .check(a_length(0.02, 2));
  command
      .add_option("--tape", options.tapes,
                  prefix + "a distance between the centres of two floor tags,\nas 1:4=3.46 (repeatable)")
      .type_name("ID:ID=LENGTH")
      .check([](const std::string& word) -> std::string {
        if (tape_in(word)) return "";
        const std::size_t sign = word.find('=');
        std::string length = sign == std::string::npos ? "" : word.substr(sign + 1);
        if (!length.empty() && tape_in(word.substr(0, sign) + "=1"))
          return a_length(kShortest_m, kLongest_m)(length);
        return "'" + word + "' is not a distance between two floor tags: write 1:4=3.46";
      })
      .one_each_time();
  command
      .add_option(
          "--readout", options.readout_ms,
          prefix +
              "how long the camera reads a picture from its first\nrow to its last, ms; negative from "
              "the last to the first")
      .type_name("MS")
      .check(console::between(-60, 60, "ms"))
      .check([](const std::string& word) -> std::string {
        const auto readout_ms = typed_number(word);
        if (!readout_ms || *readout_ms == 0 || std::abs(*readout_ms) >= 1) return "";
        return fmt::format("no camera reads a picture in {} ms: give milliseconds, as 18", word);
      });
}

film::FilmFigures figures_of(const FilmOptions& options) {
  film::FilmFigures figures;
  figures.robot_id = static_cast<int>(options.robot_tag);
  const auto length = [](const std::string& text) -> std::optional<double> {
    if (text.empty()) return std::nullopt;
    return truth::length_m_in(text, truth::LengthUnit::m);
  };
  figures.robot_side_m = length(options.tag_side);
  figures.robot_height_m = length(options.tag_height);
  figures.floor_side_m = length(options.floor_tag_side);
  for (const std::string& tape : options.tapes) figures.tapes.push_back(tape_in(tape).value());
  if (options.readout_ms) figures.readout_s = 1e-3 * *options.readout_ms;
  return figures;
}

}  // namespace astro::commands
