#include "host/import/wheels/described_wheels.hpp"

#include <tinyxml2.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "host/base/error.hpp"
#include "host/base/text/numbers.hpp"

namespace astro::importing {
namespace {

using tinyxml2::XMLElement;

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;  // of rows

Vector operator*(const Matrix& m, const Vector& v) {
  Vector out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

/// Roll, pitch and yaw about fixed axes.
Matrix rotation(const Vector& rpy) {
  const double cr = std::cos(rpy[0]), sr = std::sin(rpy[0]), cp = std::cos(rpy[1]), sp = std::sin(rpy[1]),
               cy = std::cos(rpy[2]), sy = std::sin(rpy[2]);
  return {Vector{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
          Vector{sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr}, Vector{-sp, cp * sr, cp * cr}};
}

double number(std::string_view text, const std::string& what) {
  const auto value = number_in(text);
  if (!value || !std::isfinite(*value))
    throw Error(what + " has '" + std::string(text) + "', which is no number",
                DescriptionProblem::not_a_number, {std::string(text)});
  return *value;
}

/// Reads three numbers separated by blanks; `otherwise` if the attribute is missing.
Vector vector_in(const XMLElement* element, const char* attribute, const Vector& otherwise,
                 const std::string& what) {
  const char* text = element == nullptr ? nullptr : element->Attribute(attribute);
  if (text == nullptr) return otherwise;
  Vector vector{};
  std::string_view rest = text;
  for (double& each : vector) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r\n"));
    each = number(word, what);
    rest.remove_prefix(word.size());
  }
  return vector;
}

std::string attribute(const XMLElement* element, const char* name) {
  const char* text = element == nullptr ? nullptr : element->Attribute(name);
  return text == nullptr ? "" : text;
}

class Description {
 public:
  explicit Description(std::string_view urdf) {
    if (document_.Parse(urdf.data(), urdf.size()) != tinyxml2::XML_SUCCESS)
      throw Error("the robot's description is not XML: " + std::string(document_.ErrorName()),
                  DescriptionProblem::not_xml);
    const XMLElement* robot = document_.FirstChildElement("robot");
    if (robot == nullptr) throw Error("the robot's description has no <robot>", DescriptionProblem::no_robot);
    for (const XMLElement* at = robot->FirstChildElement("joint"); at; at = at->NextSiblingElement("joint")) {
      joints_.emplace(attribute(at, "name"), at);
      above_.emplace(attribute(at->FirstChildElement("child"), "link"), at);
    }
    for (const XMLElement* at = robot->FirstChildElement("link"); at; at = at->NextSiblingElement("link"))
      links_.emplace(attribute(at, "name"), at);
  }

  bool has(const std::string& joint) const { return joints_.contains(joint); }

  double radius_m(const std::string& joint) const {
    const std::string name = attribute(this->joint(joint).FirstChildElement("child"), "link");
    const auto link = links_.find(name);
    if (link != links_.end())
      for (const char* model : {"collision", "visual"})
        for (const XMLElement* at = link->second->FirstChildElement(model); at;
             at = at->NextSiblingElement(model))
          if (const double radius_m = radius_of(at->FirstChildElement("geometry"), name); radius_m > 0)
            return radius_m;
    throw Error("the link '" + name + "' of the robot's description is no cylinder and no sphere",
                DescriptionProblem::no_round_wheel, {name});
  }

  /// The distance between both joints along the axis of the left one.
  double separation_m(const JointPair& pair) const {
    const Place left = place_of(pair.left), right = place_of(pair.right);
    const std::string what = "the axis of '" + pair.left + '\'';
    const Vector axis =
        left.turned * vector_in(joint(pair.left).FirstChildElement("axis"), "xyz", {1, 0, 0}, what);
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    if (!(length > 0)) throw Error(what + " has the length 0");
    double along = 0;
    for (std::size_t i = 0; i < 3; ++i) along += axis[i] / length * (left.at[i] - right.at[i]);
    return std::abs(along);
  }

 private:
  /// In the frame of the robot's first link.
  struct Place {
    Vector at{};
    Matrix turned{Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  };

  const XMLElement& joint(const std::string& name) const {
    const auto found = joints_.find(name);
    if (found == joints_.end())
      throw Error("the robot's description has no joint '" + name + '\'', DescriptionProblem::no_joint,
                  {name});
    return *found->second;
  }

  static double radius_of(const XMLElement* geometry, const std::string& link) {
    if (geometry == nullptr) return 0;
    for (const char* shape : {"cylinder", "sphere"})
      if (const XMLElement* found = geometry->FirstChildElement(shape))
        return number(attribute(found, "radius"), "the radius of the link '" + link + '\'');
    return 0;
  }

  Place place_of(const std::string& name) const {
    constexpr int kMostJoints = 100;  // from the first link; a longer chain is a cycle
    Place place;
    const XMLElement* at = &joint(name);
    for (int i = 0; at != nullptr; ++i) {
      if (i == kMostJoints)
        throw Error("the joint '" + name + "' hangs on no first link", DescriptionProblem::joints_in_circle,
                    {name});
      const XMLElement* origin = at->FirstChildElement("origin");
      const std::string what = "the joint '" + attribute(at, "name") + '\'';
      const Matrix turn = rotation(vector_in(origin, "rpy", {}, what));
      const Vector offset = vector_in(origin, "xyz", {}, what), moved = turn * place.at;
      for (std::size_t k = 0; k < 3; ++k) place.at[k] = moved[k] + offset[k];
      place.turned = product(turn, place.turned);
      const auto above = above_.find(attribute(at->FirstChildElement("parent"), "link"));
      at = above == above_.end() ? nullptr : above->second;
    }
    return place;
  }

  static Matrix product(const Matrix& a, const Matrix& b) {
    Matrix out{};
    for (std::size_t column = 0; column < 3; ++column) {
      const Vector turned = a * Vector{b[0][column], b[1][column], b[2][column]};
      for (std::size_t row = 0; row < 3; ++row) out[row][column] = turned[row];
    }
    return out;
  }

  tinyxml2::XMLDocument document_;
  std::map<std::string, const XMLElement*> joints_, links_, above_;  // by name; by the link below
};

}  // namespace

DescribedWheels described_wheels(std::string_view urdf, const JointPair& joints) {
  constexpr double kSame = 1e-6;
  const Description robot(urdf);
  const double left_m = robot.radius_m(joints.left), right_m = robot.radius_m(joints.right);
  if (std::abs(left_m / right_m - 1) > kSame)
    throw Error("the wheels of the robot's description have radii of " + to_text(left_m) + " m and " +
                    to_text(right_m) + " m",
                DescriptionProblem::radii_differ, {to_text(left_m), to_text(right_m)});
  const double separation_m = robot.separation_m(joints);
  if (!(separation_m > 0)) throw Error("both wheels of the robot's description are at one place of the axle");
  return {left_m, separation_m};
}

bool describes(std::string_view urdf, const JointPair& joints) {
  try {
    const Description robot(urdf);
    return robot.has(joints.left) && robot.has(joints.right);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace astro::importing
