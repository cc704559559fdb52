#include "host/commands/truth/tags_instructions.hpp"

#include <fmt/format.h>

namespace astro::commands {
namespace {

using truth::tags::Paragraph;

// 30 pixels: detectors that look at every second pixel miss a tag whose short side is below about 25.
std::vector<Paragraph> before_the_film(int robot_id) {
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

std::vector<Paragraph> after_the_film(double robot_side_mm, double floor_side_mm) {
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

}  // namespace

truth::tags::TextSheet tags_instructions(int robot_id, double robot_side_mm, double floor_side_mm) {
  truth::tags::TextSheet sheet{"Ground truth from a phone film", before_the_film(robot_id)};
  for (Paragraph& paragraph : after_the_film(robot_side_mm, floor_side_mm))
    sheet.paragraphs.push_back(std::move(paragraph));
  return sheet;
}

std::vector<std::string> notes_below_tag(truth::tags::TagRole role) {
  using truth::tags::TagRole;
  return {
      "The ruler is 100 mm long if the printer kept to 100 %. If it is not: print again at actual size,",
      "or measure the side of the black square and give what you measured.",
      role == TagRole::robot
          ? "Fix it flat and firmly on top of the robot; keep the white margin."
          : "Tape it flat to the floor, in any direction; measure from grey cross to grey cross.",
  };
}

}  // namespace astro::commands
