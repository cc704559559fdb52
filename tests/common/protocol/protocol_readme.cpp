#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "tests/common/protocol/readme_text.hpp"

/// Rewrites the generated part of the file named by its one argument.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: protocol_readme common/protocol/README.md\n";
    return 2;
  }
  std::ifstream in(argv[1]);
  const std::string before{std::istreambuf_iterator<char>(in), {}};
  const std::string after = astro::protocol::with_generated_part(before);
  if (!in.is_open() || after.empty()) {
    std::cerr << argv[1]
              << ": cannot be read, or lacks the two lines <!-- generated from the schema: ... -->\n";
    return 1;
  }
  std::ofstream out(argv[1]);
  out << after;
  if (!out.flush()) {
    std::cerr << argv[1] << ": cannot be written\n";
    return 1;
  }
}
