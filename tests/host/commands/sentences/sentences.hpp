#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "host/commands/base/advice.hpp"
#include "host/console/program.hpp"
#include "host/programs/astrolabe/all_commands.hpp"
#include "tests/support/base/temporary_folder.hpp"

/// Runs commands in this process and gives back the whole sentence that a person would read.
namespace astro::support {

/// What is printed meanwhile goes nowhere, but notices, on stderr, into a file.
class Silence {
 public:
  explicit Silence(const char* notices) {
    std::fflush(nullptr);
    redirect("/dev/null", STDOUT_FILENO);
    redirect(notices, STDERR_FILENO);
  }
  ~Silence() {
    std::fflush(nullptr);
    ::dup2(out_, STDOUT_FILENO);
    ::dup2(err_, STDERR_FILENO);
    ::close(out_);
    ::close(err_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static void redirect(const char* path, int to) {
    const int file = ::open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    ::dup2(file, to);
    ::close(file);
  }

  int out_ = ::dup(STDOUT_FILENO), err_ = ::dup(STDERR_FILENO);
};

/// The error of `astrolabe` with these words, separated by blanks; or how it ended if there was none.
inline std::string sentence_of(const std::string& line, const char* notices = "/dev/null") {
  std::vector<std::string> words{"astrolabe"};
  std::istringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  const Silence silence(notices);
  console::Program program("astrolabe", "");
  commands::add_all(program.command());
  try {
    const int code = program.run(static_cast<int>(arguments.size()), arguments.data());
    return "no error, but the exit code " + std::to_string(code);
  } catch (const Error& error) {
    return commands::in_words(error);
  }
}

/// The folder of a test, in which its commands run.
class Sentences : public testing::Test {
 protected:
  struct Case {
    std::string done, line, sentence;
  };

  Sentences() { std::filesystem::current_path(folder_.path()); }
  ~Sentences() override { std::filesystem::current_path(before_); }

  static void write(const std::string& name, const std::string& text) { std::ofstream(name) << text; }
  static std::string text_of(const std::string& name) {
    std::ifstream file(name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  static void expect(const std::vector<Case>& cases) {
    for (const Case& at : cases) EXPECT_EQ(sentence_of(at.line), at.sentence) << at.done << ": " << at.line;
  }

  /// The lines that a command says beside its result.
  static std::string notices_of(const std::string& line) {
    sentence_of(line, "notices.txt");
    return text_of("notices.txt");
  }

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
  test::TemporaryFolder folder_;
};

}  // namespace astro::support
