#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <initializer_list>
#include <string>

/// Pieces that the options of many commands are made of.
namespace astro::cli {

/// Accepts finite numbers from `least` to `greatest`; the complaint names both and the unit.
CLI::Validator between(double least, double greatest, const std::string& unit);

/// Accepts finite numbers greater than 0.
CLI::Validator positive(const std::string& unit);

/// Accepts whole numbers in decimal digits.
CLI::Validator whole(std::uint64_t least, std::uint64_t greatest);

/// Accepts finite numbers.
CLI::Validator finite();

/// Accepts "0.05%" or "0.0005", greater than 0; as a transform it leaves the plain number.
CLI::Validator fraction();

/// "Examples:" and one line each, as the footer of a command's help.
void examples(CLI::App& command, std::initializer_list<const char*> lines);

/// Adds --json.
void add_json_flag(CLI::App& command, bool& json);

}  // namespace astro::cli
