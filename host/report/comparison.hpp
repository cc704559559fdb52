#pragma once

#include <string>

#include "host/calibration/judgement/before_after.hpp"

/// The comparison of before and after in words (statistics: host/calibration/judgement/before_after.hpp).
namespace astro::report {

/// One plain sentence about the two figures of merit, values in millimetres.
std::string verdict_sentence(const calibration::FigureOfMerit& before,
                             const calibration::FigureOfMerit& after);

/// The improvement in words that need no figures beside them: "4.5 times smaller"; "at least 2.8 times
/// smaller" where there is no upper bound; "not certainly changed" where the interval contains 1.
std::string claim(const calibration::Improvement& improvement);

/// "4.5 ± 0.7 (95 %: 3.2 to 6.9)"; "82 (95 %: at least 10)" where there is no upper bound, because the
/// first-order error means nothing then; "4.5" where no error is known.
std::string describe(const calibration::Improvement& improvement);

}  // namespace astro::report
