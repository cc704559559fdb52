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
  /// The most names in one request. A request with more is not answered, because no honest client sends one.
  static constexpr std::size_t kMostNames = 1000;

  /// `middleware` and `table` must outlive it. `node`: its full name, "/robot".
  ParameterServices(Middleware& middleware, ParameterTable& table, const std::string& node);
  ParameterServices(const ParameterServices&) = delete;
  ParameterServices& operator=(const ParameterServices&) = delete;

  /// Publishes which parameters have appeared since the last call, such as those of a robot that was found, and which have
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
