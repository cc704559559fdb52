#include <gmock/gmock.h>
#include <pty.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <future>
#include <optional>
#include <string>
#include <string_view>

#include "host/console/console.hpp"

namespace astro::console {
namespace {

/// A standard stream that is another file during its lifetime.
class Redirected {
 public:
  Redirected(int stream, int file) : stream_(stream), before_(dup(stream)) { dup2(file, stream); }
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;
  ~Redirected() {
    dup2(before_, stream_);
    close(before_);
  }

 private:
  int stream_, before_;
};

/// A person at a terminal, which is this program's standard input and error.
class AtATerminal : public testing::Test {
 protected:
  AtATerminal() {
    int terminal = -1;
    if (openpty(&person_, &terminal, nullptr, nullptr, nullptr) != 0) std::abort();
    in_.emplace(STDIN_FILENO, terminal);
    err_.emplace(STDERR_FILENO, terminal);
    close(terminal);
  }
  ~AtATerminal() override {
    in_.reset();
    err_.reset();
    close(person_);
  }

  void type(std::string_view keys) const { ASSERT_EQ(write(person_, keys.data(), keys.size()), keys.size()); }

  /// Types `keys` once `prompt` is on the screen.
  std::future<void> answers(std::string prompt, std::string keys) const {
    return std::async(std::launch::async, [this, prompt, keys] {
      std::array<char, 256> chunk{};
      for (std::string seen; seen.find(prompt) == std::string::npos;) {
        const ssize_t count = read(person_, chunk.data(), chunk.size());
        if (count <= 0) return;
        seen.append(chunk.data(), static_cast<std::size_t>(count));
      }
      type(keys);
    });
  }

 private:
  int person_ = -1;
  std::optional<Redirected> in_, err_;
};

TEST_F(AtATerminal, ConfirmTakesNoAnswerThatWasTypedBeforeTheQuestionWasShown) {
  type("y\n");
  const auto person = answers("Load these? [y/N]", "n\n");
  EXPECT_FALSE(confirm("Load these?"));
}

TEST_F(AtATerminal, AnEnterThatWasHitTwiceIsNotTheAnswerToTheNextQuestionThatActs) {
  type("6\n\n");  // both lines are read with the first answer
  EXPECT_EQ(ask("heading: "), "6");
  const auto person = answers("press Enter", "redo\n");
  EXPECT_EQ(ask_before_acting("put it on its mark and press Enter "), "redo");
}

TEST_F(AtATerminal, TheBeginningOfALineIsDiscardedToo) {
  type("y");
  const auto person = answers("[y/N]", "\n");
  EXPECT_FALSE(confirm("Load these?"));
}

TEST_F(AtATerminal, NumbersMayBeTypedAheadOfTheirQuestions) {
  type("12\n34\n");
  EXPECT_EQ(ask("x: "), "12");
  EXPECT_EQ(ask("y: "), "34");
}

TEST(Piped, AnswersAreTakenInTheirOrderByEveryQuestion) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  const std::string answers = "12\n\ny\n";
  ASSERT_EQ(write(pipe_ends[1], answers.data(), answers.size()), answers.size());
  close(pipe_ends[1]);
  const Redirected in(STDIN_FILENO, pipe_ends[0]);
  close(pipe_ends[0]);
  testing::internal::CaptureStderr();
  EXPECT_EQ(ask("x: "), "12");
  EXPECT_EQ(ask_before_acting("press Enter "), "");
  EXPECT_EQ(ask("is it right? "), "y");
  testing::internal::GetCapturedStderr();
}

}  // namespace
}  // namespace astro::console
