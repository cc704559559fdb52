#pragma once

#include "host/base/text/sense.hpp"
#include "host/report/report.hpp"

/// Inputs for the report: the end errors that the thesis measured (tables 11 to 14) with drives that make
/// errors of the same kind.
namespace astro::report {

/// Two phases, before and after UMBmark, with the thesis's end errors. Each direction has `squares` recorded
/// runs, each phase one circle per direction and one line.
ReportInput thesis_input(int squares = 2);

/// One noisy drive of `seconds` at 50 Hz; odometry and truth share nothing but the motion.
recording::Run example_run(const std::string& kind, std::optional<Sense> direction, int index, double seconds,
                           double wheel_error, unsigned seed);

}  // namespace astro::report
