#include "host/commands/calibrate/ml_option.hpp"

#include "host/base/text/degrees.hpp"
#include "host/console/options.hpp"

namespace astro::commands {

experiment::MlChoice MlOption::choice() const {
  using Clock = experiment::MlChoice::Clock;
  experiment::MlChoice chosen;
  if (noise_option.count() > 0) {
    chosen.noise = noise;
    chosen.noise->sigma_theta_rad = radians(sigma_theta_deg);
  }
  if (clock_option.count() > 0) chosen.clock = clock == "known" ? Clock::known : Clock::estimated;
  return chosen;
}

void add_ml(console::Command command, MlOption& ml) {
  const console::Option K = command.add_option("--K", ml.noise.K_m, "ml: wheel slip, variance per metre, m")
                                .check(console::positive("m"));
  const console::Option xy =
      command.add_option("--sigma-xy", ml.noise.sigma_xy_m, "ml: noise of ground truth per coordinate, m")
          .check(console::positive("m"));
  const console::Option theta =
      command
          .add_option("--sigma-theta", ml.sigma_theta_deg,
                      "ml: noise of its heading, degrees; without all\nthree the noise is estimated")
          .check(console::positive("degrees"));
  K.needs(xy).needs(theta);
  xy.needs(K).needs(theta);
  theta.needs(K).needs(xy);
  ml.noise_option = K;
  ml.clock_option = command
                        .add_option("--clock", ml.clock,
                                    "ml: known: ground truth has the robot's times;\n"
                                    "estimated: offsets and skew are found;\n"
                                    "default: what the recordings say")
                        .one_of({"known", "estimated"});
}

}  // namespace astro::commands
