#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "host/base/error.hpp"
#include "host/live/web/server.hpp"
#include "host/page/robot/opened_robot.hpp"

namespace astro::dashboard {

struct Settings {
  web::Address address{};
  std::filesystem::path page;  // the folder of the page's files, with index.html
  page::RobotPorts ports{};    // `list` and `open` are called in two threads
  std::string port{};          // of the robot that is opened at the start; "": the pages choose
  /// Gets the recordings that no page has removed when the dashboard ends.
  std::filesystem::path recordings = ".";
  std::function<void(const Remark&)> notice = [](const Remark&) {};  // called in any thread
  /// A page that answers no ping for so long has gone, and a robot that it drives is stopped.
  std::chrono::seconds page_timeout{4};
};

/// Serves the page, and a robot to it, until it is destroyed; then a robot that a page drives is at rest and disarmed, and what was
/// recorded is kept.
class Dashboard {
 public:
  /// Throws astro::Error if the address cannot be had, or there is no page in the folder.
  explicit Dashboard(const Settings& settings);
  ~Dashboard();
  Dashboard(const Dashboard&) = delete;
  Dashboard& operator=(const Dashboard&) = delete;

  std::uint16_t port() const;
  /// What stands behind the server's name in the link for people: the token as fragment, which no browser sends anywhere.
  std::string path_of_link() const;
  /// A file of this user alone that leads a browser to `link`: in the words of a command everybody could read the token.
  std::filesystem::path file_leading_to(const std::string& link) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What is wrong with the page's folder. Values: the folder.
enum class DashboardProblem { no_page };

}  // namespace astro::dashboard
