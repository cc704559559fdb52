#pragma once

namespace astro::support::film {

/// When rows are exposed. The middle of row v's exposure is v / rows * readout_s after that of row 0; a negative readout reads
/// from the bottom row to the top one.
struct Shutter {
  double readout_s = 0.020, exposure_s = 0.008;

  double row_s(double first_row_s, double row, int rows) const {
    return first_row_s + row / rows * readout_s;
  }
};

}  // namespace astro::support::film
