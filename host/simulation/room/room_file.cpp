#include "host/simulation/room/room_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "host/base/error.hpp"
#include "host/base/text/plain_text.hpp"
#include "host/experiment/files/toml_file.hpp"

namespace astro::simulation {
namespace {

constexpr double kFarthest_m = 1000, kFastest_mps = 10, kThickest_m = 2;
constexpr std::size_t kMostWalls = 500, kMostPeople = 50;

/// What a file may say in one place, with the file's name and the line in each error.
class RoomReader {
 public:
  explicit RoomReader(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const toml::node& node, std::string_view name, const std::string& what,
                         RoomProblem problem = RoomProblem::wrong_value) const {
    const std::string line = std::to_string(node.source().begin.line);
    throw Error(fmt::format("'{}' line {}: {} {}", file_, line, name, what), problem,
                {file_, line, std::string(name)});
  }

  void require_known(const toml::table& table, std::initializer_list<std::string_view> names) const {
    for (const auto& [key, node] : table)
      if (std::ranges::find(names, key.str()) == names.end())
        fail(node, "'" + plain_text(std::string(key.str())) + "'",
             fmt::format("is nothing that a room has here: possible are {}", fmt::join(names, ", ")),
             RoomProblem::unknown_name);
  }

  double number(const toml::table& table, std::string_view name, double otherwise, double least,
                double most) const {
    const toml::node* node = table.get(name);
    return node == nullptr ? otherwise : number(*node, name, least, most);
  }
  bool flag(const toml::table& table, std::string_view name) const {
    const toml::node* node = table.get(name);
    if (node == nullptr) return false;
    const auto value = node->value_exact<bool>();
    if (!value) fail(*node, name, "is neither true nor false");
    return *value;
  }

  /// Points that follow one another; no two neighbours are the same.
  std::vector<Point2> points(const toml::table& table, std::string_view name, std::size_t least) const {
    const toml::node* node = table.get(name);
    if (node == nullptr) fail(table, name, fmt::format("is missing: {}", kForm));
    const toml::array* list = node->as_array();
    if (list == nullptr || list->size() < least)
      fail(*node, name, fmt::format("is not a list of at least {} points: {}", least, kForm));
    std::vector<Point2> points;
    for (const toml::node& each : *list) {
      points.push_back(point(each, name));
      if (const std::size_t count = points.size(); count > 1 && same(points[count - 2], points[count - 1]))
        fail(each, name, "has the same point twice in a row: leave one out");
    }
    return points;
  }

  /// The tables under [[name]]; none if the file does not have it.
  std::vector<const toml::table*> tables(const toml::table& file, std::string_view name) const {
    const toml::node* node = file.get(name);
    if (node == nullptr) return {};
    const toml::array* list = node->as_array();
    if (list == nullptr) fail(*node, name, fmt::format("is not a list: write [[{}]] above each one", name));
    std::vector<const toml::table*> tables;
    for (const toml::node& each : *list) {
      tables.push_back(each.as_table());
      if (tables.back() == nullptr)
        fail(each, name, fmt::format("is not a list of tables: write [[{}]] above each one", name));
    }
    return tables;
  }

  const std::string& file() const { return file_; }

 private:
  static constexpr const char* kForm = "write [[0, 0], [4, 0]] for two points in m";

  static bool same(const Point2& a, const Point2& b) { return a.x_m == b.x_m && a.y_m == b.y_m; }

  double number(const toml::node& node, std::string_view name, double least, double most) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= least && *value <= most))
      fail(node, name, fmt::format("is not a number from {} to {}", least, most));
    return *value;
  }
  Point2 point(const toml::node& node, std::string_view name) const {
    const toml::array* pair = node.as_array();
    if (pair == nullptr || pair->size() != 2)
      fail(node, name, fmt::format("holds what is no point: {}", kForm));
    return {number((*pair)[0], name, -kFarthest_m, kFarthest_m),
            number((*pair)[1], name, -kFarthest_m, kFarthest_m)};
  }

  std::string file_;
};

void add_walls(const RoomReader& reader, const toml::table& wall, Room& room) {
  reader.require_known(wall, {"corners"});
  const std::vector<Point2> corners = reader.points(wall, "corners", 2);
  for (std::size_t i = 1; i < corners.size(); ++i) room.walls.push_back({corners[i - 1], corners[i]});
  if (room.walls.size() > kMostWalls)
    reader.fail(wall, "wall",
                fmt::format("is one too many: a room has at most {} straight pieces", kMostWalls),
                RoomProblem::too_many);
}

void add_person(const RoomReader& reader, const toml::table& person, Room& room) {
  reader.require_known(person, {"path", "radius", "speed"});
  Walker walker;
  walker.path = reader.points(person, "path", 1);
  walker.speed_mps = reader.number(person, "speed", walker.speed_mps, 0, kFastest_mps);
  walker.radius_m = reader.number(person, "radius", walker.radius_m, 0.01, kThickest_m);
  room.people.push_back(walker);
  if (room.people.size() > kMostPeople)
    reader.fail(person, "person", fmt::format("is one too many: a room has at most {}", kMostPeople),
                RoomProblem::too_many);
}

void place_scanner(const RoomReader& reader, const toml::table& scanner, RoomFile& file) {
  reader.require_known(scanner, {"upside_down", "x", "y", "yaw"});
  constexpr double kReach_m = 1, kTurn_deg = 360;
  file.scanner_mount = {reader.number(scanner, "x", 0, -kReach_m, kReach_m),
                        reader.number(scanner, "y", 0, -kReach_m, kReach_m),
                        reader.number(scanner, "yaw", 0, -kTurn_deg, kTurn_deg) * std::numbers::pi / 180};
  file.scanner_upside_down = reader.flag(scanner, "upside_down");
}

}  // namespace

RoomFile read_room(const std::filesystem::path& path) {
  const toml::table table = experiment::parse_toml(path);
  const RoomReader reader(path.string());
  reader.require_known(table, {"person", "scanner", "wall"});
  RoomFile file;
  for (const toml::table* wall : reader.tables(table, "wall")) add_walls(reader, *wall, file.room);
  for (const toml::table* person : reader.tables(table, "person")) add_person(reader, *person, file.room);
  if (const toml::node* scanner = table.get("scanner")) {
    if (!scanner->is_table())
      reader.fail(*scanner, "scanner", "is not a table: write [scanner] above its lines");
    place_scanner(reader, *scanner->as_table(), file);
  }
  if (file.room.walls.empty())
    throw Error(
        fmt::format("'{}' has no walls: write [[wall]] and corners = [[0, 0], [4, 0]] (in m) for each",
                    reader.file()),
        RoomProblem::no_walls, {reader.file()});
  return file;
}

}  // namespace astro::simulation
