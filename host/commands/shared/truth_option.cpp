#include "host/commands/shared/truth_option.hpp"

#include <algorithm>

#include "host/base/error.hpp"
#include "host/base/text/columns.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/shared/film_truth.hpp"
#include "host/commands/shared/press_enter.hpp"
#include "host/console/console.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/truth/files/file_source.hpp"
#include "host/truth/live/live_source.hpp"
#include "host/truth/live/ros_scan_link.hpp"
#include "host/truth/live/rplidar_link.hpp"
#include "host/truth/live/scanner_source.hpp"
#include "host/truth/live/socket_source.hpp"

namespace astro::commands {
namespace {

constexpr Advice kTruthAdvice[] = {
    {truth::SocketProblem::not_served, ": --truth sim needs a robot started with 'astrolabe sim'"},
};

std::unique_ptr<truth::Source> open_scanner(std::unique_ptr<truth::ScanLink> link,
                                            const TruthOption& option) {
  auto source = std::make_unique<truth::ScannerSource>(
      std::move(link), option.mirrored ? truth::Mirrored::yes : truth::Mirrored::no);
  console::say("laser scanner: " + source->description());
  return source;
}

void require_scans_for(const TruthOption& option) {
  if (option.mirrored)
    throw console::WrongUsage("--truth-mirrored is of scans, and --truth " + option.source + " gives none");
}

std::unique_ptr<truth::Source> open_on_network(const TruthOption& option) {
  const truth::TrackerUrl url = truth::tracker_url_in(option.source);
  if (url.scheme == "ros2" && truth::carries_scans(url))
    return open_scanner(std::make_unique<truth::RosScanLink>(url), option);
  require_scans_for(option);
  auto source = std::make_unique<truth::LiveSource>(url);
  console::say("ground truth: " + source->description());
  return source;
}

/// "sim, manual, vrpn://HOST/BODY, natnet://HOST/BODY or ros2:/TOPIC"
std::string choice_of(const std::vector<std::string>& words) {
  std::string choice;
  for (const std::string& word : words) choice += (word == "lidar" ? "lidar:PORT" : word) + ", ";
  return choice + "vrpn://HOST/BODY, natnet://HOST/BODY or ros2:/TOPIC";
}

}  // namespace

void add_mirrored_scans(console::Command command, TruthOption& option) {
  command.add_flag("--truth-mirrored", option.mirrored,
                   "the laser scanner hangs upside down, or its beams\nrun the other way round than it says");
}

console::Check truth_source(std::vector<std::string> words) {
  advise(kTruthAdvice);
  return [words = std::move(words)](const std::string& word) -> std::string {
    const std::string kind = film_named(word) ? "film" : truth::scanner_port_in(word) ? "lidar" : word;
    if (std::find(words.begin(), words.end(), kind) != words.end())
      return word == "lidar" ? "'lidar' names no port: write lidar:PORT, as lidar:/dev/ttyUSB0" : "";
    if (!truth::is_tracker_url(word))
      return "'" + word + "' is not a source of ground truth: choose " + choice_of(words);
    try {
      truth::tracker_url_in(word);
      return "";
    } catch (const Error& error) {
      return in_words(error);
    }
  };
}

std::string in_words(const truth::Question& question) {
  const std::string text = in_words(question.occasion) + question.text;
  switch (question.answer) {
    case truth::AnswerKind::file_saved:
      return text + "; press Enter once it is there: ";
    case truth::AnswerKind::file_corrected:
      return text + "; press Enter once the file is corrected: ";
    case truth::AnswerKind::file_corrected_or_kept:
      return text + " Press Enter once the file is corrected, or to keep it as it is: ";
    case truth::AnswerKind::right_or_entered_again:
      return wrapped(text) + "  yes: it is right; Enter: enter it again: ";
    default:
      return text;
  }
}

std::string ask_person(const truth::Question& question) {
  switch (question.answer) {
    case truth::AnswerKind::file_saved:
    case truth::AnswerKind::file_corrected:
    case truth::AnswerKind::file_corrected_or_kept:
      press_enter(console::ask_before_acting, in_words(question));  // the next run may be driven at once
      return "";
    default:
      return console::ask(in_words(question));
  }
}

std::unique_ptr<truth::Source> open_truth(const TruthOption& option, const std::string& port,
                                          const truth::Ask& asking) {
  if (const auto scanner = truth::scanner_port_in(option.source))
    return open_scanner(std::make_unique<truth::RplidarLink>(*scanner), option);
  if (truth::is_tracker_url(option.source)) return open_on_network(option);
  require_scans_for(option);
  if (option.source == "sim") return std::make_unique<truth::SocketSource>(truth::mocap_socket_of(port));
  if (option.source == "manual") return std::make_unique<truth::ManualSource>(asking, option.units);
  if (option.source == "file") return std::make_unique<truth::FileSource>(option.folder, asking);
  if (option.source == "film") return std::make_unique<truth::LaterSource>("film");
  if (option.source == "none") return std::make_unique<truth::NoSource>();
  throw Error("'" + option.source + "' is not a source of ground truth: choose sim, manual, file or none");
}

}  // namespace astro::commands
