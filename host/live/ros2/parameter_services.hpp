#pragma once

#include <memory>
#include <set>
#include <string>

#include "host/live/driver/middleware.hpp"
#include "host/live/ros2/parameter_answers.hpp"

namespace astro::live {

/// The six services by which others see and change the parameters of a node, and the topic on which they are told of changes.
class ParameterServices {
 public:
  /// In one request. A longer list is no request of anybody who means it.
  static constexpr std::size_t kMostNames = 1000;

  /// `middleware` and `table` must outlive it. `node`: its full name, "/robot".
  ParameterServices(Middleware& middleware, ParameterTable& table, const std::string& node);
  ParameterServices(const ParameterServices&) = delete;
  ParameterServices& operator=(const ParameterServices&) = delete;

  /// Tells which parameters are there now and were not when it was called before, as those of a robot that was found, and which have
  /// gone.
  void look();

 private:
  template <class Service>
  void serve(Middleware& middleware, const std::string& name);
  void tell(ros2::msg::ParameterEvent event);

  ParameterTable& table_;
  std::string node_;
  std::set<std::string> known_;
  std::unique_ptr<Publisher> events_;
  ParameterAnswers answers_;
};

}  // namespace astro::live
