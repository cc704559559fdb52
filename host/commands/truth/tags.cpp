#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "host/base/files.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/truth/commands.hpp"
#include "host/commands/truth/tags_instructions.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/truth/tags/pdf.hpp"
#include "host/truth/tags/tag_picture.hpp"

namespace astro::commands {
namespace {

namespace tags = truth::tags;

struct TagsOptions {
  std::filesystem::path pdf;
  std::string paper = "a4";
  int robot_id = 0;
  std::vector<std::string> floor_ids{"1", "2", "3", "4", "5", "6"};
  double robot_side_mm = 120, floor_side_mm = 160;
};

std::vector<int> numbers_in(const std::vector<std::string>& words) {
  std::vector<int> numbers;
  for (const std::string& word : words) {
    int number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || number < 0 || number >= tags::kTagCount)
      throw console::WrongUsage(
          fmt::format("--floor-ids: '{}' is not a whole number from 0 to {}", word, tags::kTagCount - 1));
    numbers.push_back(number);
  }
  return numbers;
}

/// A tag that lies in two places cannot be told apart from itself.
void require_different(int robot, const std::vector<int>& floor) {
  std::set<int> seen{robot};
  for (const int id : floor)
    if (!seen.insert(id).second)
      throw console::WrongUsage(
          fmt::format("tag {} would be there twice: give each tag an id of its own "
                      "with --robot-id and --floor-ids",
                      id));
}

void require_fits(const char* option, double side_mm, const tags::Paper& paper) {
  const double most_mm = tags::largest_side_mm(paper);
  if (side_mm <= most_mm) return;
  throw console::WrongUsage(fmt::format(
      "{} {:g}: with its white margin and the ruler it does not fit on {} paper, where {:g} mm is the most",
      option, side_mm, paper.name, most_mm));
}

tags::TagSheet sheet_of(tags::TagRole role, int id, double side_mm) {
  return {role, id, side_mm, notes_below_tag(role)};
}

void run(const TagsOptions& options) {
  const tags::Paper paper = tags::paper_named(options.paper).value();
  const std::vector<int> floor = numbers_in(options.floor_ids);
  require_different(options.robot_id, floor);
  require_fits("--robot-side", options.robot_side_mm, paper);
  require_fits("--floor-side", options.floor_side_mm, paper);
  std::vector<tags::Sheet> sheets{
      tags_instructions(options.robot_id, options.robot_side_mm, options.floor_side_mm),
      sheet_of(tags::TagRole::robot, options.robot_id, options.robot_side_mm)};
  for (const int id : floor) sheets.push_back(sheet_of(tags::TagRole::floor, id, options.floor_side_mm));
  require_own_kind(options.pdf, tags::kPdfMark, "PDF");
  PartFile file(options.pdf);
  file.write(tags::pdf_of(sheets, paper, "Astrolabe: tags for a phone film"));
  file.commit();
  print_path(options.pdf);
}

}  // namespace

void add_tags(console::Command app) {
  const auto options = std::make_shared<TagsOptions>();
  const console::Command command =
      app.add_subcommand("tags", "print the tags for ground truth from a phone film");
  command
      .add_option("--pdf", options->pdf,
                  "write them into this file, one for each page,\nafter a page of instructions")
      .type_name("FILE")
      .required();
  command.add_option("--paper", options->paper, "the printer's paper")
      .one_of({std::string(tags::kA4.name), std::string(tags::kLetter.name)})
      .capture_default_str();
  command.add_option("--robot-id", options->robot_id, "number of the robot's tag")
      .type_name("ID")
      .check(console::whole(0, tags::kTagCount - 1))
      .capture_default_str();
  console::add_ranged(command, "--robot-side", options->robot_side_mm, "side of its black square", "MM", 10,
                      200, "mm");
  command.add_option("--floor-ids", options->floor_ids, "numbers of the tags on the floor (1,2,3,4,5,6)")
      .type_name("ID,ID,...")
      .delimiter(',');
  console::add_ranged(command, "--floor-side", options->floor_side_mm, "side of their black squares", "MM",
                      10, 200, "mm");
  console::examples(command, {"astrolabe tags --pdf tags.pdf", "astrolabe tags --pdf tags.pdf --paper letter",
                              "astrolabe tags --pdf small.pdf --robot-side 90 --floor-ids 11,12,13,14"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
