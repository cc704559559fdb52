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
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/film/picture/pdf.hpp"
#include "host/film/picture/tag_picture.hpp"
#include "host/film/picture/tag_sheet.hpp"
#include "host/film/picture/text_sheet.hpp"

namespace astro::commands {
namespace {

namespace tags = film::paper;

struct TagsOptions {
  std::filesystem::path pdf;
  std::string paper = "a4";
  int robot_id = 0;
  std::vector<std::string> floor_ids{"1", "2", "3", "4", "5", "6"};
  double robot_side_mm = 120, floor_side_mm = 160;
};

// 30 pixels: detectors that look at every second pixel miss a tag whose short side is below about 25.
std::vector<tags::Paragraph> before_the_film(int robot_id) {
  return {
      {"1  Print",
       "Print all sheets at 100 % (\"actual size\", not \"fit to page\"), on matt paper. The ruler on each "
       "sheet must be 100 mm long. If it is not, print again, or go on with the sides as you measure them."},
      {"2  The robot's tag",
       fmt::format(
           "Fix tag {} flat and firmly on top of the robot, arrow to the front. It may be cut out along "
           "the dashed line; the white margin has to stay. It must not rock or bend, and nothing may "
           "hide it from the camera. Where it is on the robot need not be measured.",
           robot_id)},
      {"3  The tags on the floor",
       "Tape four to six of them flat around the field, in any direction, where the robot does not drive. "
       "Put two far apart, about 3 m. They must stay where they are for the whole film."},
      {"4  The camera",
       "Put the phone on a shelf or on stairs, 2 m high or higher, looking down by 35 degrees or more, so "
       "that "
       "it sees all tags on the floor and all of the robot's way. Use the main lens without zoom, 1080p with "
       "30 "
       "frames a second, focus and exposure locked, stabilisation off. A tag must be 30 pixels high also in "
       "the far corner: 1/36 of the height of a 1080p picture."},
      {"5  The film",
       "Start the film first and then the drives. Film everything in one go and do not touch the phone. The "
       "robot stands still for two seconds before and after each run. Nobody else's tags are in the "
       "picture."},
  };
}

std::vector<tags::Paragraph> after_the_film(double robot_side_mm, double floor_side_mm) {
  const std::string blank = "__________";
  return {
      {"6  Measure and note",
       fmt::format("Side of the black square of the robot's tag ({:g} mm):  {} mm\n"
                   "Side of the black squares on the floor ({:g} mm):  {} mm\n"
                   "Height of the robot's tag above the floor, within 1 mm:  {} mm\n"
                   "From the grey cross of floor tag ____ to that of floor tag ____, within 2 mm:  {} m",
                   robot_side_mm, blank, floor_side_mm, blank, blank, blank)},
      {"",
       "Without the last one the ratio of the wheels and the wheelbase over the wheels' size are found just "
       "as "
       "well; the scale is then only as good as the sides of the printed tags."},
      {"7  Use it",
       "Copy the original file from the phone: messengers compress films and change their times. Look at it "
       "first; this says which tags were found, how well, and what to film differently:\n"
       "    astrolabe truth film FILE.mp4\n"
       "Then it is the ground truth of drives that were recorded, or of an experiment:\n"
       "    astrolabe calibrate runs FOLDER --truth film:FILE.mp4\n"
       "    astrolabe umbmark --truth film:FILE.mp4 --out FOLDER"},
  };
}

/// The page that comes before the tags: how a film is made that a calibration can use.
tags::TextSheet tags_instructions(int robot_id, double robot_side_mm, double floor_side_mm) {
  tags::TextSheet sheet{"Ground truth from a phone film", before_the_film(robot_id)};
  for (tags::Paragraph& paragraph : after_the_film(robot_side_mm, floor_side_mm))
    sheet.paragraphs.push_back(std::move(paragraph));
  return sheet;
}

/// Three lines below a tag: how the scale is checked and how the sheet is fixed.
std::vector<std::string> notes_below_tag(tags::TagRole role) {
  return {
      "The ruler is 100 mm long if the printer kept to 100 %. If it is not: print again at actual size,",
      "or measure the side of the black square and give what you measured.",
      role == tags::TagRole::robot
          ? "Fix it flat and firmly on top of the robot; keep the white margin."
          : "Tape it flat to the floor, in any direction; measure from grey cross to grey cross.",
  };
}

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

/// Refuses a number that is given twice, because two tags with one number cannot be told apart.
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
