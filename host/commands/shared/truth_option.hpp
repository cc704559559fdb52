#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host/console/command_line.hpp"
#include "host/truth/source/manual_source.hpp"
#include "host/truth/source/reading.hpp"
#include "host/truth/source/source.hpp"

namespace astro::commands {

/// --truth: where ground truth comes from. One of these words, or the address of a tracker on the network
/// (host/truth/live/tracker_url.hpp).
///   sim     the virtual cameras beside the port of an 'astrolabe sim'
///   manual  a person with a tape measure is asked after each run
///   file    each run's ground truth is read from a CSV that another program wrote
///   film    a phone films the robot's tag, and the film is taken once all runs of a phase are driven (umbmark only)
///   none    nothing (record only)
///   lidar:PORT  a laser scanner on the robot, at a serial port of this computer
/// A topic of ROS 2 may carry scans, too. Scans are recorded, and where the robot was follows from them.
struct TruthOption {
  std::string source;
  std::filesystem::path folder;  // file: where the CSV files appear
  truth::Units units;            // manual: of numbers without one
  bool mirrored = false;         // scans are mirror images
};

/// --truth-mirrored.
void add_mirrored_scans(console::Command command, TruthOption& option);

/// Accepts these words and the addresses of trackers.
console::Check truth_source(std::vector<std::string> words);

/// The question with the key that answers it.
std::string in_words(const truth::Question& question);

/// Asks at the terminal.
std::string ask_person(const truth::Question& question);

/// Opens the source, and says what a source on the network turned out to be. `asking`: how to ask a person, if the source
/// does. Throws astro::Error if the source cannot be opened.
std::unique_ptr<truth::Source> open_truth(const TruthOption& option, const std::string& port,
                                          const truth::Ask& asking = ask_person);

}  // namespace astro::commands
