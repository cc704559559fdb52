#include <fstream>
#include <iostream>
#include <string>

#include "tests/host/python/messages_text.hpp"

namespace {

bool write(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  out << text;
  if (out.flush()) return true;
  std::cerr << path << ": cannot be written\n";
  return false;
}

}  // namespace

/// Writes what the Python package and its tests have from the schema.
int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: python_messages host/python/astrolabe/messages.py tests/host/python/vectors.json\n";
    return 2;
  }
  const bool written =
      write(argv[1], astro::python::messages_text()) && write(argv[2], astro::python::vectors_text());
  return written ? 0 : 1;
}
