#pragma once

#include <string>

namespace astro::python {

/// The module messages.py of the Python package: enumerations, messages and their layout, written from the schema of the
/// protocol and of the programs that share a port.
std::string messages_text();

/// Messages, damaged bodies and streams of bytes as JSON, with what encode, decode and the framer make of them. Both
/// codecs, this one and Python's, are tested by it.
std::string vectors_text();

}  // namespace astro::python
