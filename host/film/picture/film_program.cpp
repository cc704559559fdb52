#include "host/film/picture/film_program.hpp"

#include <array>
#include <cerrno>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/system_error.hpp"

namespace astro::film {

FilmProgram::FilmProgram(std::vector<std::string> words, ChildProcess::Line line,
                         std::chrono::milliseconds patience)
    : name_(words.at(0)), patience_(patience) {
  constexpr const char* kInstall = ": install ffmpeg ('apt install ffmpeg'), which has it";
  const int failure = child_.start(std::move(words), ChildProcess::Output::bytes, std::move(line));
  if (failure == ENOENT) throw Error(described() + "is not installed" + kInstall);
  if (failure != 0) throw system_error(described() + "cannot be started", failure, kInstall);
}

std::string FilmProgram::described() const { return "the program '" + name_ + "', which reads films, "; }

void FilmProgram::wait() {
  if (!child_.wait(patience_))
    throw Error(described() + "has neither said anything nor ended for " + std::to_string(patience_.count()) +
                    " ms: name the film that the phone recorded (MP4 or MOV)",
                FilmProgramProblem::silent, {name_, std::to_string(patience_.count())});
}

std::size_t FilmProgram::read(std::span<std::uint8_t> bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size() && child_.writes_bytes()) {
    wait();
    filled += child_.read(bytes.subspan(filled));
  }
  return filled;
}

bool FilmProgram::finish() {
  std::array<std::uint8_t, 4096> rest;
  while (read(rest) == rest.size()) continue;
  while (child_.writes_lines()) wait();
  return child_.finish(patience_) == 0;
}

}  // namespace astro::film
