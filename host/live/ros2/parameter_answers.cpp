#include "host/live/ros2/parameter_answers.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace astro::live {
namespace {

using Descriptors = std::map<std::string, ros2::msg::ParameterDescriptor, std::less<>>;

Descriptors by_name(ParameterTable& table) {
  Descriptors descriptors;
  for (ros2::msg::ParameterDescriptor& each : table.descriptors()) {
    std::string name = each.name;
    descriptors.emplace(std::move(name), std::move(each));
  }
  return descriptors;
}

/// The results of `each` for the descriptors with these names; nothing if one of the names has no descriptor.
template <class Each>
auto for_all(const std::vector<std::string>& names, const Descriptors& descriptors, Each each) {
  std::vector<decltype(each(descriptors.begin()->second))> results;
  for (const std::string& name : names) {
    const auto found = descriptors.find(name);
    if (found == descriptors.end()) return decltype(results){};
    results.push_back(each(found->second));
  }
  return results;
}

bool within(std::string_view name, std::uint64_t depth) {
  return depth == 0 || static_cast<std::uint64_t>(std::count(name.begin(), name.end(), '.')) < depth;
}

bool is_listed(std::string_view name, const ros2::msg::ListParameters::Request& request) {
  if (request.prefixes.empty()) return within(name, request.depth);
  return std::any_of(request.prefixes.begin(), request.prefixes.end(), [&](const std::string& prefix) {
    if (name == prefix) return true;
    return name.starts_with(prefix + '.') && within(name.substr(prefix.size() + 1), request.depth);
  });
}

}  // namespace

ParameterAnswers::ParameterAnswers(ParameterTable& table, OnChange on_change)
    : table_(table), on_change_(std::move(on_change)) {}

ros2::msg::GetParameters::Response ParameterAnswers::to(
    const ros2::msg::GetParameters::Request& request) const {
  ros2::msg::GetParameters::Response response;
  for (const std::string& name : request.names) {
    std::optional<ros2::msg::ParameterValue> value = table_.value(name);
    if (!value) return {};
    response.values.push_back(std::move(*value));
  }
  return response;
}

ros2::msg::GetParameterTypes::Response ParameterAnswers::to(
    const ros2::msg::GetParameterTypes::Request& request) const {
  return {for_all(request.names, by_name(table_), [](const auto& descriptor) { return descriptor.type; })};
}

ros2::msg::DescribeParameters::Response ParameterAnswers::to(
    const ros2::msg::DescribeParameters::Request& request) const {
  return {for_all(request.names, by_name(table_), [](const auto& descriptor) { return descriptor; })};
}

ros2::msg::ListParameters::Response ParameterAnswers::to(
    const ros2::msg::ListParameters::Request& request) const {
  ros2::msg::ListParametersResult result;
  std::set<std::string> prefixes;
  for (const auto& [name, descriptor] : by_name(table_)) {
    if (!is_listed(name, request)) continue;
    result.names.push_back(name);
    if (const std::size_t dot = name.rfind('.'); dot != std::string::npos)
      prefixes.insert(name.substr(0, dot));
  }
  result.prefixes.assign(prefixes.begin(), prefixes.end());
  return {std::move(result)};
}

ros2::msg::SetParameters::Response ParameterAnswers::to(const ros2::msg::SetParameters::Request& request) {
  ros2::msg::SetParameters::Response response;
  // A robot writes its flash once for each set, so all parameters are tried as one set first. If that is refused, each is
  // tried alone.
  if (request.parameters.size() > 1 && set(request.parameters).successful) {
    response.results.assign(request.parameters.size(), {true, ""});
    return response;
  }
  for (const ros2::msg::Parameter& each : request.parameters) response.results.push_back(set({&each, 1}));
  return response;
}

ros2::msg::SetParametersAtomically::Response ParameterAnswers::to(
    const ros2::msg::SetParametersAtomically::Request& request) {
  return {set(request.parameters)};
}

ros2::msg::SetParametersResult ParameterAnswers::set(std::span<const ros2::msg::Parameter> parameters) {
  ros2::msg::SetParametersResult result = table_.set(parameters);
  if (!result.successful || parameters.empty()) return result;
  std::vector<ros2::msg::Parameter> changed(parameters.begin(), parameters.end());
  for (ros2::msg::Parameter& each : changed)
    if (std::optional<ros2::msg::ParameterValue> value = table_.value(each.name))
      each.value = std::move(*value);
  on_change_(changed);
  return result;
}

}  // namespace astro::live
