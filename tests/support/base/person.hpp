#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "host/truth/source/manual_source.hpp"

namespace astro::support {

/// Answers in order, and remembers what was asked. An answer too few ends the test.
class Person {
 public:
  explicit Person(std::deque<std::string> answers) : answers_(std::move(answers)) {}

  std::string operator()(const std::string& prompt) {
    asked.push_back(prompt);
    const std::string answer = answers_.at(0);
    answers_.pop_front();
    return answer;
  }
  std::string operator()(const truth::Question& question) {
    return (*this)(question.occasion.sentence + question.text);
  }

  std::vector<std::string> asked;

 private:
  std::deque<std::string> answers_;
};

}  // namespace astro::support
