#include "host/film/track/figure_doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "host/film/track/scene_search.hpp"
#include "tests/host/film/camera/synthetic_scene.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/thorough.hpp"

// A person measured something wrongly: the film and the other figures show it.
namespace astro::film {
namespace {

using support::Tells;
using testing::_;
using testing::StartsWith;

constexpr const char* kTape = "the distance from floor tag 1 to 4";

constexpr double kNoise_px = 0.02;

/// What a film of this scene shows, with all rows read at once.
class Filmed {
 public:
  explicit Filmed(Scene scene) : scene_(std::move(scene)) {
    scene_.readout_s = 0;
    std::mt19937 random(20261125);
    for (TagCorners corners : support::seen_floor(scene_)) {
      support::add_noise(corners, kNoise_px, random);
      floor_.push_back({scene_.tags[floor_.size()].id, corners});
    }
    for (RobotSighting one : support::seen_robot(scene_, 120)) {
      support::add_noise(one.corners, kNoise_px, random);
      robot_.push_back({static_cast<double>(robot_.size()) / 30, one.corners, 1});
    }
  }

  FilmFigures true_figures() const {
    FilmFigures figures;
    figures.floor_side_m = scene_.floor_side_m;
    figures.robot_side_m = scene_.robot_side_m;
    figures.robot_height_m = scene_.robot_height_m;
    figures.readout_s = 0;
    figures.tapes = {{1, 4, distance_between(scene_, 1, 4).value()}};
    return figures;
  }
  double growth(const FilmFigures& figures) const {
    return growth_of_error(given_figures(figures, fit(figures)));
  }
  SceneFit fit(const FilmFigures& figures) const {
    return find_scene({scene_.width_px, scene_.height_px, 0, "", 30, 10, 300}, floor_, robot_, figures);
  }
  std::optional<FigureDoubt> doubt(const FilmFigures& figures) const {
    return doubt_about_figures(figures, fit(figures), [&](const FilmFigures& with) { return fit(with); });
  }

 private:
  Scene scene_;
  std::vector<SeenFloorTag> floor_;
  std::vector<RobotTagSeen> robot_;
};

struct Mistake {
  const char* what;
  std::function<void(FilmFigures&)> make;
  testing::Matcher<Remark> tells;
  bool gross;
};

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> all{
      {"a digit too many in the height", [](FilmFigures& f) { f.robot_height_m = 0.0121; },
       Tells(FilmProblem::figures_contradict, "the side of the robot's tag", _, "120.0 mm",
             "the height of the robot's tag", StartsWith("1"), "12.1 mm"),
       true},
      {"a height above the camera", [](FilmFigures& f) { f.robot_height_m = 3; },
       Tells(FilmProblem::figure_wrong, "the height of the robot's tag", StartsWith("1"), "3.000 m"), true},
      {"a tape read at the wrong mark", [](FilmFigures& f) { f.tapes[0].length_m -= 0.06; },
       Tells(FilmProblem::figures_contradict, kTape, StartsWith("3.1"), _, StartsWith("98.")), false},
      {"a tape in another unit", [](FilmFigures& f) { f.tapes[0].length_m /= 10; },
       Tells(FilmProblem::figure_wrong, kTape, StartsWith("3.1"), _), true},
      {"the white margin counted as part of the floor tags", [](FilmFigures& f) { f.floor_side_m = 0.2; },
       Tells(FilmProblem::figure_wrong, "the side of the floor tags", _, "200.0 mm"), true},
      {"the white margin counted as part of the robot's tag", [](FilmFigures& f) { f.robot_side_m = 0.15; },
       Tells(FilmProblem::figure_wrong, "the side of the robot's tag", _, "150.0 mm"), true},
      {"sides that are exchanged", [](FilmFigures& f) { std::swap(f.robot_side_m, f.floor_side_m); },
       Tells(FilmProblem::figures_exchanged, "the sides of the robot's tag and of the floor tags", "160.0 mm",
             "120.0 mm"),
       true},
  };
  return all;
}

TEST(FigureDoubts, HaveNothingAgainstFiguresThatARulerShows) {
  for (const Scene& scene : {support::phone_scene(), support::ceiling_scene()}) {
    const Filmed film(scene);
    EXPECT_FALSE(film.doubt(film.true_figures()).has_value());
    // Twice the error of a ruler each, in the directions that contradict each other most.
    FilmFigures rough = film.true_figures();
    *rough.floor_side_m += 8e-4;
    *rough.robot_side_m -= 8e-4;
    *rough.robot_height_m += 4e-3;
    rough.tapes[0].length_m -= 4e-3;
    const auto doubt = film.doubt(rough);
    EXPECT_FALSE(doubt.has_value()) << doubt->remark.sentence;
  }
}

TEST(FigureDoubts, NameTheFigureThatAllOthersContradict) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  const Filmed film(support::phone_scene());
  for (const Mistake& mistake : mistakes()) {
    FilmFigures figures = film.true_figures();
    mistake.make(figures);
    const auto doubt = film.doubt(figures);
    ASSERT_TRUE(doubt.has_value()) << mistake.what;
    EXPECT_THAT(doubt->remark, mistake.tells) << mistake.what;
    EXPECT_EQ(doubt->gross, mistake.gross) << mistake.what << ": " << doubt->remark.sentence;
  }
}

FilmFigures nothing_given() {
  FilmFigures figures;
  figures.readout_s = 0;
  return figures;
}

TEST(FigureDoubts, KnowATapeByThePrintedSizeOfTheTagsButRefuseNothingForThat) {
  const Filmed film(support::phone_scene());
  FilmFigures figures = nothing_given();
  figures.tapes = {{1, 4, film.true_figures().tapes[0].length_m / 10}};
  const auto doubt = film.doubt(figures);
  ASSERT_TRUE(doubt.has_value());
  EXPECT_THAT(doubt->remark, Tells(FilmProblem::figure_wrong, kTape, _, _));
  EXPECT_FALSE(doubt->gross) << "nothing that was measured contradicts it";
  figures.robot_height_m = film.true_figures().robot_height_m;
  figures.tapes[0].length_m *= 100;
  const auto too_long = film.doubt(figures);
  ASSERT_TRUE(too_long.has_value());
  EXPECT_THAT(too_long->remark, Tells(FilmProblem::figure_wrong, kTape, _, _));
  EXPECT_TRUE(too_long->gross) << "the robot's tag is not found with it";
}

TEST(FigureDoubts, HaveNothingAgainstAFilmOfWhichNothingWasMeasured) {
  for (const double floor_m : {0.08, 0.113, 0.16, 0.2}) {
    Scene scene = support::phone_scene();
    scene.floor_side_m = floor_m;
    scene.robot_side_m = 0.1;
    EXPECT_FALSE(Filmed(scene).doubt(nothing_given()).has_value()) << floor_m;
  }
}

TEST(FigureDoubts, TellARobotThatIsHigherThanUsualFromAWrongSide) {
  Scene scene = support::phone_scene();
  scene.robot_height_m = 0.4;
  const Filmed film(scene);
  for (const bool with_tape : {true, false}) {
    FilmFigures figures = film.true_figures();
    figures.robot_height_m.reset();
    if (!with_tape) figures.tapes.clear();
    const auto doubt = film.doubt(figures);
    ASSERT_TRUE(doubt.has_value());
    EXPECT_THAT(doubt->remark, Tells(FilmProblem::unusual_height));
    EXPECT_FALSE(doubt->gross);
    EXPECT_EQ(film.growth(doubt->figures), 1) << "the scale is as certain as without the usual height";
    EXPECT_NEAR(film.fit(doubt->figures).scene.robot_height_m, 0.4, 0.03);
  }
}

TEST(FigureDoubts, TellSheetsOfAnotherSizeFromAWrongTape) {
  Scene scene = support::phone_scene();
  scene.floor_side_m *= 0.71;  // A4 printed on A5
  scene.robot_side_m *= 0.71;
  const Filmed film(scene);
  FilmFigures figures = film.true_figures();
  figures.floor_side_m.reset();
  figures.robot_side_m.reset();
  const auto doubt = film.doubt(figures);
  ASSERT_TRUE(doubt.has_value());
  EXPECT_EQ(doubt->remark.sentence, "");
  EXPECT_FALSE(doubt->gross);
  const auto sides = unusual_sides(figures, film.fit(doubt->figures).scene);
  ASSERT_EQ(sides.size(), 2U);
  for (const UnusualSide& side : sides) EXPECT_NEAR(side.part(), 0.29, 0.01);
}

TEST(FigureDoubts, LookAtTheSidesThatAWrongHeightBends) {
  // Nothing that was measured checks the height; but the sheets of both tags come from one printer.
  const Filmed film(support::phone_scene());
  FilmFigures figures = nothing_given();
  figures.robot_height_m = 0.0121;
  figures.tapes = film.true_figures().tapes;
  const auto sides = unusual_sides(figures, film.fit(figures).scene);
  ASSERT_EQ(sides.size(), 1U);
  EXPECT_EQ(sides[0].kind, FigureKind::robot_side);
  EXPECT_NEAR(sides[0].part(), 0.055, 0.01);
  figures.robot_height_m = film.true_figures().robot_height_m;
  EXPECT_TRUE(unusual_sides(figures, film.fit(figures).scene).empty());
}

TEST(FigureDoubts, NameATapeThatIsTooLongAlthoughAPrinterCouldScale) {
  const Filmed film(support::phone_scene());
  FilmFigures figures = film.true_figures();
  figures.tapes[0].length_m *= 1.06;
  const auto doubt = film.doubt(figures);
  ASSERT_TRUE(doubt.has_value());
  EXPECT_THAT(doubt->remark, Tells(FilmProblem::figure_wrong, kTape, _, _));
  EXPECT_TRUE(doubt->gross);
}

TEST(FigureDoubts, LetTheErrorGrowFromTwoStandardErrorsOn) {
  FigureCheck one;
  one.measured = {1, 0.01};
  one.by_others = {1.015, 0.01};
  EXPECT_EQ(growth_of_error({one}), 1);
  one.by_others.value = 1.04;
  EXPECT_NEAR(growth_of_error({one, one}), 4 / std::sqrt(2), 1e-9);
  EXPECT_EQ(growth_of_error({}), 1);
}

TEST(FigureDoubts, TellAPrinterThatScalesFromAWrongTape) {
  Scene scene = support::phone_scene();
  scene.floor_side_m *= 0.97;
  scene.robot_side_m *= 0.97;
  const Filmed film(scene);
  FilmFigures figures = film.true_figures();
  *figures.floor_side_m /= 0.97;
  *figures.robot_side_m /= 0.97;
  const auto doubt = film.doubt(figures);
  ASSERT_TRUE(doubt.has_value());
  EXPECT_THAT(doubt->remark, Tells(FilmProblem::figures_contradict, kTape, _, _, StartsWith("97.")));
  EXPECT_FALSE(doubt->gross);
}

TEST(FigureDoubts, LetTheErrorOfTheScaleGrowForSeveralSmallMistakes) {
  const Filmed film(support::phone_scene());
  FilmFigures figures = film.true_figures();
  const Scene truth = support::phone_scene();
  for (const auto& [from, to] : {std::pair(2, 3), std::pair(1, 5), std::pair(2, 4)})
    figures.tapes.push_back({from, to, distance_between(truth, from, to).value()});
  figures.tapes[1].length_m += 0.02;
  figures.tapes[3].length_m -= 0.02;
  const auto doubt = film.doubt(figures);
  ASSERT_TRUE(doubt.has_value());
  EXPECT_THAT(doubt->remark, Tells(FilmProblem::several_figures_wrong));
  EXPECT_FALSE(doubt->gross);
  EXPECT_GT(film.growth(doubt->figures), 3.5);
}

TEST(FigureDoubts, SayThatSeveralMayBeWrongIfTheFilmCannotTell) {
  // From straight above nothing but the two of them shows the scale.
  const Filmed film(support::ceiling_scene());
  FilmFigures figures;
  figures.readout_s = 0;
  figures.floor_side_m = film.true_figures().floor_side_m;
  figures.tapes = {{1, 4, 1.1 * film.true_figures().tapes[0].length_m}};
  const auto doubt = film.doubt(figures);
  ASSERT_TRUE(doubt.has_value());
  EXPECT_THAT(doubt->remark,
              Tells(FilmProblem::figures_contradict, "the side of the floor tags", _, _, kTape, _, _));
  EXPECT_TRUE(doubt->gross);
}

}  // namespace
}  // namespace astro::film
