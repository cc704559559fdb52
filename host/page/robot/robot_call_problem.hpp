#pragma once

namespace astro::page {

/// Why a page may not do what it asks. Values: for needs_confirmation the parameters' assignments, for another_page the number of the
/// page that drives.
enum class RobotCallProblem {
  no_robot,
  another_robot,
  another_page,
  not_armed,
  halted,
  path_under_way,
  measuring,
  needs_confirmation
};

}  // namespace astro::page
