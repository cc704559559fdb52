#include "host/import/drives/stated_drives.hpp"

#include <gmock/gmock.h>

#include "host/import/drives/unused_choice.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::importing {
namespace {

using support::told_by;
using testing::ElementsAre;

TEST(StatedDrives, AnAxisIsALetterOrADirection) {
  EXPECT_EQ(axis_named("y"), (truth::Direction3{0, 1, 0}));
  EXPECT_EQ(axis_named("-z"), (truth::Direction3{0, 0, -1}));
  EXPECT_EQ(axis_named("0,-2.5,1"), (truth::Direction3{0, -2.5, 1}));
  for (const char* none : {"", "w", "--z", "-", "0,0,0", "1,2", "1,2,3,4", "a,b,c", "up"})
    EXPECT_EQ(axis_named(none), std::nullopt) << none;
}

TEST(StatedDrives, WhatIsStatedWronglyIsToldByItsKind) {
  const auto kind = [](const auto& change) {
    StatedDrives drives;
    change(drives);
    return told_by([&] { choices_of(drives); }).kind;
  };
  EXPECT_EQ(kind([](auto& d) { d.up = "north"; }), Kind(StatementProblem::unknown_axis));
  EXPECT_EQ(kind([](auto& d) { d.wheels_unit = "furlongs"; }), Kind(StatementProblem::unknown_unit));
  EXPECT_EQ(kind([](auto& d) { d.joints = {"left"}; }), Kind(StatementProblem::joints_not_paired));
  EXPECT_EQ(kind([](auto& d) { d.joints = {"a+b", "c"}; }), Kind(StatementProblem::joints_not_paired));
  EXPECT_EQ(kind([](auto& d) { d.joints = {"a+", "c+d"}; }), Kind(StatementProblem::joints_not_paired));
  EXPECT_EQ(kind([](auto& d) { d.frames = {"map"}; }), Kind(StatementProblem::frames_not_two));
  StatedDrives half;
  half.wheels = {"a.csv", "b.csv"};
  half.truth = {"t.csv"};
  const auto told = told_by([&] { import_stated(half); });
  EXPECT_EQ(told.kind, Kind(StatementProblem::not_paired));
  EXPECT_THAT(told.values, ElementsAre("2", "1"));
}

TEST(StatedDrives, WheelsOfOneSideKeepTheirOrder) {
  StatedDrives drives;
  drives.joints = {"fl+rl", "fr+rr"};
  const ImportChoices choices = choices_of(drives);
  EXPECT_EQ(choices.wheels.bag.joints, (JointPair{"fl", "fr"}));
  EXPECT_THAT(choices.wheels.bag.further, ElementsAre(JointPair{"rl", "rr"}));
}

TEST(StatedDrives, NothingIsStatedAtFirstAndEachStatementHasItsName) {
  StatedDrives drives;
  EXPECT_THAT(stated_choices(drives), ElementsAre());
  drives.table.per_interval = true;
  drives.wheelbase_m = 0.3;
  EXPECT_THAT(stated_choices(drives), ElementsAre(Choice::per_interval, Choice::wheelbase));
  EXPECT_EQ(name_of(Choice::truth_mirrored), "truth_mirrored");
  EXPECT_EQ(name_of(Choice::drives_backward), "drives_backward");
}

}  // namespace
}  // namespace astro::importing
