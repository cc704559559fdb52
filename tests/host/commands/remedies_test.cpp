#include "host/commands/base/remedies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

/// The words that the commands have for the kinds of help. That their options and subcommands exist is tested with the
/// program (tests/host/programs/remedies_test.cpp).
namespace astro::commands {
namespace {

struct Case {
  Help help;
  std::string value, words;
};

/// What depends on the surroundings of the program: rights, other programs, the environment, a command to repeat.
TEST(RemedyWords, OfTheSurroundingsSayExactlyWhatToDo) {
  for (const Case& c : {
           Case{Help::join_serial_group, "", "usermod -aG dialout $USER"},
           {Help::set_runtime_folder, "", "XDG_RUNTIME_DIR"},
           {Help::await_or_kill_program, "4711", "let it go on, or end it with 'kill -9 4711'"},
           {Help::await_or_end_program, "", "let it go on, or end it"},
           {Help::end_program, "", "end that program first"},
           {Help::end_some_programs, "", "end some of them"},
           {Help::stop_other_program, "", "'astrolabe stop'"},
           {Help::resume_for_truth, "", "the same command goes on"},
           {Help::resume_experiment, "runs/a", "'astrolabe umbmark --out runs/a'"},
           {Help::drive_run_again, "a/b.mcap", "remove 'a/b.mcap'"},
           {Help::upload_again_when_it_answers, "", "upload again once it answers"},
           {Help::set_observer_bandwidth, "240", "observer_bandwidth of 240 rad/s"},
           {Help::build_image, "", "./dev firmware"},
           {Help::check_permissions_and_disk, "", "check its permissions and the disk"},
           {Help::check_disk_or_use_other_folder, "", "check the disk or choose another folder"},
       })
    EXPECT_THAT(in_words(Remedy{c.help, c.value}), testing::HasSubstr(c.words));
}

TEST(RemedyWords, FollowTheFactOfAnErrorAndOfARemark) {
  const Error error("cannot read a.mcap", {Help::check_permissions_and_disk});
  EXPECT_EQ(in_words(error), "cannot read a.mcap: check its permissions and the disk");
  EXPECT_EQ(in_words(Remark{"run 3 slipped", {Help::leave_run_out, "3"}}),
            "run 3 slipped: leave it out (of a folder: 'astrolabe calibrate runs --without 3')");
  EXPECT_EQ(in_words(Remark{"nothing to do"}), "nothing to do");
}

/// A value may come from a file; braces in it are no place for another value.
TEST(RemedyWords, TakeAValueAsItStands) {
  EXPECT_THAT(in_words(Remedy{Help::drive_run_again, "{}{0}.mcap"}), testing::HasSubstr("'{}{0}.mcap'"));
}

}  // namespace
}  // namespace astro::commands
