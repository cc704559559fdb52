#include <gmock/gmock.h>

#include <fstream>
#include <set>
#include <sstream>

#include "tests/support/base/places.hpp"
#include "tests/support/ros2/robot_on_ros.hpp"

/// The tables of host/live/README.md say what the driver does.
namespace astro::live {
namespace {

using testing::ElementsAreArray;

/// The rows of the table under a heading, each as "cell | cell | ..." of the first `columns` columns.
std::set<std::string> table(const std::string& heading, int columns) {
  std::ifstream file(support::checkout() / "host/live/README.md");
  std::set<std::string> rows;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ") || line.starts_with("### ")) inside = line.ends_with("# " + heading);
    if (!inside || !line.starts_with("| `")) continue;
    std::istringstream cells(line.substr(2));
    std::string row, cell;
    for (int i = 0; i < columns && std::getline(cells, cell, '|'); ++i)
      row += (i == 0 ? "" : "|") + cell.substr(cell.find_first_not_of(' '),
                                               cell.find_last_not_of(' ') + 1 - cell.find_first_not_of(' '));
    rows.insert(row);
  }
  return rows;
}

std::string row_of(const TopicDescription& topic) {
  return '`' + topic.name + "`|" + std::string(topic.type.name) + '|' +
         (topic.reliable ? "reliable" : "best effort") + (topic.latched ? ", latched" : "") + '|' +
         std::to_string(topic.depth);
}

TEST(ReadmeOfRos2, ListsTheTopicsThatThereAre) {
  support::RobotOnRos bench;
  std::set<std::string> published, subscribed;
  for (const auto& [name, topic] : bench.ros.published) published.insert(row_of(topic.description));
  for (const auto& topic : bench.ros.subscribed) subscribed.insert(row_of(topic));
  EXPECT_THAT(table("Published", 4), ElementsAreArray(published));
  EXPECT_THAT(table("Subscribed", 4), ElementsAreArray(subscribed));
}

TEST(ReadmeOfRos2, ListsTheServicesThatThereAre) {
  support::RobotOnRos bench;
  std::set<std::string> served;
  for (const auto& [name, service] : bench.ros.services)
    served.insert('`' + name + "`|" + std::string(service.type));
  EXPECT_THAT(table("Services", 2), ElementsAreArray(served));
}

TEST(ReadmeOfRos2, ListsTheParametersOfTheNode) {
  support::RobotOnRos bench;
  std::set<std::string> own;
  for (const auto& each : bench.ros.parameters->descriptors()) own.insert('`' + each.name + '`');
  EXPECT_THAT(table("Parameters", 1), ElementsAreArray(own));
}

}  // namespace
}  // namespace astro::live
