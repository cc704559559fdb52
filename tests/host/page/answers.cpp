#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "host/page/calls/calls.hpp"

/// The page's calls as this machine's own program, which is what the module in the browser is compared with. Reads questions, a
/// line of JSON for each: {"call": ..., "question": ...}, and prints each answer as a line.      page_answers FOLDER
int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: page_answers FOLDER\n";
    return 2;
  }
  for (std::string line; std::getline(std::cin, line);) {
    const auto asked = nlohmann::json::parse(line);
    std::cout << astro::page::json_text(astro::page::answer(asked.at("call"), asked.at("question"), argv[1],
                                                            [](const nlohmann::json&) {}))
              << std::endl;
  }
}
