#include "tests/host/report/browser.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

namespace astro::report {

namespace {

namespace fs = std::filesystem;

std::string attribute(const std::string& tag, const std::string& name) {
  const auto at = tag.find(name + "=\"");
  if (at == tag.npos) return "";
  const auto begin = at + name.size() + 2;
  return tag.substr(begin, tag.find('"', begin) - begin);
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

bool browser_is_installed() { return std::system("command -v chromium >/dev/null") == 0; }

namespace {

/// Runs the browser on `html` with `wish`, whose "@" stands for the folder of the page; returns what it
/// prints.
std::string browse(const std::string& html, std::string wish, int virtual_ms,
                   const std::function<void(const fs::path& folder)>& then) {
  std::string name = fs::temp_directory_path() / "astrolabe-browser-XXXXXX";
  const fs::path folder = mkdtemp(name.data());
  std::ofstream(folder / "page.html", std::ios::binary) << html;
  if (const auto at = wish.find('@'); at != wish.npos) wish.replace(at, 1, name);
  const std::string command =
      "HOME='" + name +
      "' timeout 120 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
      "--disable-background-networking --disable-component-update --disable-sync --disable-dev-shm-usage "
      "--window-size=1280,900 --user-data-dir='" +
      name + "/profile' --virtual-time-budget=" + std::to_string(virtual_ms) + " " + wish + " 'file://" +
      name + "/page.html' 2>/dev/null";
  std::string dom;
  if (FILE* pipe = popen(command.c_str(), "r")) {
    std::array<char, 65536> block;
    while (const auto n = fread(block.data(), 1, block.size(), pipe)) dom.append(block.data(), n);
    pclose(pipe);
  }
  then(folder);
  fs::remove_all(folder);
  return dom;
}

}  // namespace

std::string open_in_browser(const std::string& html, int virtual_ms) {
  return browse(html, "--dump-dom", virtual_ms, [](const fs::path&) {});
}

int pages_on_paper(const std::string& html) {
  std::string pdf;
  browse(html, "--no-pdf-header-footer --print-to-pdf='@/page.pdf'", 60'000, [&](const fs::path& folder) {
    std::ifstream file(folder / "page.pdf", std::ios::binary);
    pdf.assign(std::istreambuf_iterator<char>(file), {});
  });
  return count(pdf, "/Type /Page") - count(pdf, "/Type /Pages");
}

std::vector<DrawnFigure> figures_of(const std::string& whole) {
  const std::string dom = whole.substr(0, whole.find("id=\"report-data\""));
  std::vector<DrawnFigure> figures;
  for (auto at = dom.find("<figure "); at != dom.npos; at = dom.find("<figure ", at + 1)) {
    const std::string part = dom.substr(at, dom.find("</figure>", at) - at);
    const std::string tag = part.substr(0, part.find('>'));
    figures.push_back({attribute(tag, "data-figure"), attribute(tag, "data-group"),
                       attribute(tag, "data-phase"), attribute(tag, "data-drawn") == "true",
                       tag.find("data-error") != tag.npos, count(part, "<g class=\"trace scatter"),
                       count(part, "class=\"js-line\"") + count(part, "<path class=\"point\"")});
  }
  return figures;
}

}  // namespace astro::report
