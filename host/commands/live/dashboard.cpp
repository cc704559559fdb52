#include "host/live/dashboard/dashboard.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "host/base/child_process.hpp"
#include "host/base/environment.hpp"
#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/live/commands.hpp"
#include "host/commands/live/listen_option.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct DashboardOptions {
  ConnectionOptions connection;
  ListenOption listen{"8770", {}};
  fs::path page, recordings = ".";
  bool no_browser = false;
};

/// Beside the program as it is installed, or in the folder in which it was built.
fs::path usual_page() {
  std::error_code unknown;
  const fs::path bin = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  const fs::path installed = bin.parent_path() / "share" / "astrolabe" / "page";
  return fs::is_directory(installed, unknown) ? installed : bin.parent_path().parent_path() / "page";
}

std::vector<page::RobotPort> robots_at_ports(unsigned baud) {
  std::vector<page::RobotPort> ports;
  for (const robot::FoundPort& found : find_robots(baud))
    ports.push_back({found.port.address, found.robot ? fmt::format("{} ({})", found.robot->robot_name.view(),
                                                                   found.robot->board.view())
                                                     : in_words(found.reason)});
  return ports;
}

dashboard::Settings settings_of(const DashboardOptions& options) {
  dashboard::Settings settings;
  settings.address = listen_address_in(options.listen.listen);
  settings.page = options.page.empty() ? usual_page() : options.page;
  settings.ports.list = [baud = options.connection.baud] { return robots_at_ports(baud); };
  settings.ports.open = [baud = options.connection.baud](const std::string& path) {
    return open_port({path, baud});
  };
  settings.port = options.connection.port;
  settings.recordings = options.recordings;
  settings.notice = [](const Remark& remark) { console::say(in_words(remark)); };
  return settings;
}

/// Where a browser of this computer finds the server. It has no name, because whoever answers to a name would get the token: at
/// `localhost` another user of this computer may have the address ::1.
std::string own_place(const std::string& ip, std::uint16_t port) {
  const std::string own = ip == "0.0.0.0" ? "127.0.0.1" : ip == "::" ? "::1" : ip;
  return fmt::format("{}:{}", own.find(':') == own.npos ? own : '[' + own + ']', port);
}

void warn_of_network(const std::string& ip) {
  if (!is_loopback(ip))
    console::say(
        "WARNING: other computers can connect, and nothing is encrypted: whoever sees this link, or the "
        "network's "
        "traffic, can DRIVE THE ROBOT");
}

/// Where there is a screen, a browser shows the link; where there is none, or no browser, the link is printed all the same.
void open_browser(ChildProcess& browser, const fs::path& file) {
  if (environment_variable("DISPLAY").empty() && environment_variable("WAYLAND_DISPLAY").empty()) return;
  browser.start({"xdg-open", file.string()}, ChildProcess::Output::lines, [](std::string_view) {});
}

/// If there is one robot, that is it; if there are none or several, people choose in the page.
void find_only_robot(ConnectionOptions& connection) {
  try {
    connect(connection);
  } catch (const Error&) {
    connection.port.clear();
  }
}

void run(DashboardOptions& options) {
  take_listen_port(options.connection.port, options.listen);
  if (options.connection.port.empty()) find_only_robot(options.connection);
  const dashboard::Dashboard dashboard(settings_of(options));
  const std::string ip = listen_address_in(options.listen.listen).ip;
  const std::string link = "http://" + own_place(ip, dashboard.port()) + dashboard.path_of_link();
  print(link);
  if (ip == "0.0.0.0" || ip == "::")
    print("from another computer: the same, with the address of this computer in that network");
  warn_of_network(ip);
  console::say("open this link in a browser; Ctrl-C ends it, and stops a robot that a page drives");
  ChildProcess browser;
  if (!options.no_browser) open_browser(browser, dashboard.file_leading_to(link));
  while (!console::interrupted()) ::poll(nullptr, 0, 100);  // a signal ends the wait
}

constexpr Advice kDashboardAdvice[] = {
    {dashboard::DashboardProblem::no_page, ": './dev web' builds it, or --page names another folder"},
};

}  // namespace

void add_dashboard(console::Command app) {
  advise(kDashboardAdvice);
  const auto options = std::make_shared<DashboardOptions>();
  const console::Command command =
      app.add_subcommand("dashboard", "a robot in a web page: watch it, drive it, set it up; and your data");
  add_connection(command, options->connection);
  add_listen(
      command, options->listen,
      "where browsers connect; without an address\nfrom this computer alone. --port with a bare\nnumber "
      "says the same");
  command
      .add_option("--page", options->page, "the page's files (default: those that were\ninstalled or built)")
      .type_name("FOLDER");
  command
      .add_option("--recordings", options->recordings,
                  "where recordings go at the end that no page\nhas saved (default: here)")
      .type_name("FOLDER");
  command.add_flag("--no-browser", options->no_browser, "print the link and open no browser");
  console::examples(command, {"astrolabe dashboard", "astrolabe dashboard --port /dev/ttyACM0",
                              "astrolabe dashboard --listen 8771 --no-browser"});
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
