#include "host/report/report.hpp"

#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "host/base/error.hpp"
#include "host/report/assets.hpp"
#include "host/report/figures.hpp"
#include "host/report/html.hpp"
#include "host/report/sections.hpp"

namespace astro::report {

namespace {

/// Removes the temporary file unless the rename has taken it away.
struct Cleanup {
  const std::filesystem::path& path;
  ~Cleanup() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

}  // namespace

std::string render_page(const std::string& title, const std::vector<Section>& sections,
                        const nlohmann::json& data) {
  std::string links, body;
  for (const Section& s : sections) {
    if (s.body.empty()) continue;
    links += "<a href=\"#" + s.id + "\">" + s.heading + "</a>\n";
    body += "<section id=\"" + s.id + "\"><h2>" + s.heading + "</h2>\n" + s.body + "</section>\n";
  }
  return fill(assets::template_html(), {{"title", escape(title)},
                                        {"style", std::string(assets::style_css())},
                                        {"links", links},
                                        {"body", body},
                                        {"data", script_json(data)},
                                        {"library", std::string(assets::library_js())},
                                        {"script", std::string(assets::script_js())}});
}

std::string render_html(const ReportInput& input) {
  const auto groups = group_runs(input.phases);
  return render_page(input.title,
                     {headline(input), parameter_table(input), history(input), scatter(input),
                      factor_table(input), rms_tables(input), run_figures(input, groups), provenance(input)},
                     figure_data(input.phases, groups));
}

void write_report(const std::filesystem::path& path, const ReportInput& input) {
  write_page(path, render_html(input));
}

void write_page(const std::filesystem::path& path, const std::string& html) {
  std::filesystem::path temporary = path;
  temporary += ".part-" + std::to_string(getpid());
  const Cleanup cleanup{temporary};
  std::ofstream file(temporary, std::ios::binary);
  file << html;
  file.close();
  std::error_code failure;
  if (file) std::filesystem::rename(temporary, path, failure);
  if (!file || failure) {
    throw Error("cannot write the report " + path.string() +
                ": name a file in a folder that exists, takes new files and has space");
  }
}

}  // namespace astro::report
