#include "host/commands/shared/truth_option.hpp"

#include "host/base/error.hpp"
#include "host/commands/base/remedies.hpp"
#include "host/console/console.hpp"
#include "host/truth/files/file_source.hpp"
#include "host/truth/live/socket_source.hpp"
#include "host/truth/source/no_source.hpp"

namespace astro::commands {

std::string ask_person(const truth::Question& question) {
  return console::ask(in_words(question.occasion) + question.text);
}

std::unique_ptr<truth::Source> open_truth(const TruthOption& option, const std::string& port,
                                          const truth::Ask& asking) {
  if (option.source == "sim") return std::make_unique<truth::SocketSource>(truth::mocap_socket_of(port));
  if (option.source == "manual") return std::make_unique<truth::ManualSource>(asking);
  if (option.source == "file") return std::make_unique<truth::FileSource>(option.folder, asking);
  if (option.source == "none") return std::make_unique<truth::NoSource>();
  throw Error("'" + option.source + "' is not a source of ground truth: choose sim, manual, file or none");
}

}  // namespace astro::commands
