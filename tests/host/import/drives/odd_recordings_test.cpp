#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <set>

#include "host/calibration/likelihood/likelihood_problem.hpp"
#include "host/experiment/analysis/calibration.hpp"
#include "host/formats/tables/table.hpp"
#include "host/import/drives/import_drives.hpp"
#include "host/import/wheels/counter_wraps.hpp"
#include "host/import/wheels/unclear_choice.hpp"
#include "host/import/wheels/wheel_csv.hpp"
#include "tests/host/calibration/ml_drives.hpp"
#include "tests/host/import/drives/drive_files.hpp"
#include "tests/support/base/temporary_folder.hpp"

// One robot, recorded in the ways that people record theirs. Each recording gives the right factors, within three of the
// errors that are stated, or is refused for the reason that it has. None is silently wrong.
namespace astro::importing {
namespace {

namespace fs = std::filesystem;
using calibration::Trajectory;
using TruthAt = calibration::BodySample;
using WheelsAt = calibration::WheelSample;

/// What a person has: files, and perhaps something to say about them.
struct Recording {
  std::vector<DriveFiles> files;
  ImportChoices choices;
};

/// Four drives of one robot. Each is written anew, in a folder of its own.
class Robot {
 public:
  static constexpr double kWheelbase_m = 0.29;

  explicit Robot(const fs::path& folder) : folder_(folder) {
    model.metres_per_count = test::kMetresPerCount;
    model.clock_offset_s = 0.02;
    drives = calibration::squares(model, 4, 2);
  }

  static double counts(double travel_m) { return std::floor(travel_m / test::kMetresPerCount + 1e-6); }
  static double radians(double travel_m) { return 2 * travel_m / test::kDiameter_m; }

  Recording recording() const {
    Recording out;
    out.choices.geometry.wheel_diameter_m = test::kDiameter_m;
    out.choices.geometry.counts_per_turn = test::kCountsPerTurn;
    out.choices.geometry.wheelbase_m = kWheelbase_m;
    return out;
  }

  /// The drives with these texts of wheels, and their ground truth as TUM unless another text is given.
  Recording with(const std::function<std::string(const Trajectory&)>& wheels,
                 const std::function<std::string(const Trajectory&)>& truth = {}) const {
    Recording out = recording();
    for (std::size_t i = 0; i < drives.size(); ++i) {
      const fs::path w = folder_ / fmt::format("w{}", i), t = folder_ / fmt::format("t{}", i);
      write(w, wheels(drives[i]));
      if (truth)
        write(t, truth(drives[i]));
      else
        test::write_tum(t, drives[i]);
      out.files.push_back({w, t});
    }
    return out;
  }

  simulation::study::DriveModel model = calibration::astro_drive();
  std::vector<Trajectory> drives;

 private:
  static void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }
  fs::path folder_;
};

template <class Samples, class Row>
std::string rows(std::string head, const Samples& samples, Row row) {
  for (const auto& sample : samples) head += row(sample) + "\n";
  return head;
}

std::string with_commas(std::string text) {
  for (char& c : text) c = c == ',' ? ';' : c == '.' ? ',' : c;
  return text;
}

std::string utf16(const std::string& text) {
  std::string out = "\xFF\xFE";
  for (const char c : text) out += {c, '\0'};
  return out;
}

std::string counts_in(const Trajectory& run, const char* head = "time_s,left_counts,right_counts\n") {
  return rows(head, run.wheels, [](const WheelsAt& at) {
    return fmt::format("{:.6f},{},{}", at.time_s, Robot::counts(at.left_m), Robot::counts(at.right_m));
  });
}

/// Counts of a counter with this range, which begins somewhere.
std::string counts_around(const Trajectory& run, double range) {
  return rows("time_s,left_counts,right_counts\n", run.wheels, [=](const WheelsAt& at) {
    const auto around = [=](double count) { return count - range * std::floor(count / range); };
    return fmt::format("{:.6f},{},{}", at.time_s, around(Robot::counts(at.left_m) + 100),
                       around(Robot::counts(at.right_m) + 200));
  });
}

Trajectory every_nth(const Trajectory& run, std::size_t n) {
  Trajectory slow = run;
  slow.wheels.clear();
  for (std::size_t i = 0; i < run.wheels.size(); i += n) slow.wheels.push_back(run.wheels[i]);
  return slow;
}

/// Counters of few bits that a slow log reads, of encoders with as few counts as fit: one of `coarser` counts.
/// The first drive may be logged more slowly than the others.
Recording slow_counters(const Robot& robot, double range, double coarser, std::size_t every,
                        std::size_t first = 0) {
  Recording recording = robot.with([&](const Trajectory& run) {
    const std::size_t n = first > 0 && run.name == robot.drives.front().name ? first : every;
    return rows("time_s,left_counts,right_counts\n", every_nth(run, n).wheels, [&](const WheelsAt& at) {
      const auto around = [&](double travel_m, double start) {
        const double count = std::floor(Robot::counts(travel_m) / coarser) + start;
        return count - range * std::floor(count / range);
      };
      return fmt::format("{:.6f},{},{}", at.time_s, around(at.left_m, 10), around(at.right_m, 20));
    });
  });
  *recording.choices.geometry.counts_per_turn /= coarser;
  return recording;
}

/// Counts whose times are written as `written` says.
std::string counts_at(const Trajectory& run, const char* time, const std::function<double(double)>& written) {
  return rows(fmt::format("{},left_counts,right_counts\n", time), run.wheels, [&](const WheelsAt& at) {
    return fmt::format("{},{},{}", written(at.time_s), Robot::counts(at.left_m), Robot::counts(at.right_m));
  });
}

std::string clock_time(double time_s) {
  const double of_day = std::fmod(time_s, 86'400);
  const int minutes = static_cast<int>(of_day / 60);
  return fmt::format("{:02d}:{:02d}:{:09.6f}", minutes / 60, minutes % 60, of_day - 60 * minutes);
}

Trajectory changed(Trajectory run, const std::function<void(WheelsAt&)>& change) {
  for (WheelsAt& sample : run.wheels) change(sample);
  return run;
}

Trajectory without(Trajectory run, double from_s, double to_s) {
  std::erase_if(run.wheels, [=](const WheelsAt& at) { return at.time_s > from_s && at.time_s < to_s; });
  return run;
}

std::string truth_in(const Trajectory& run, const char* head,
                     const std::function<std::string(const TruthAt&)>& row) {
  return rows(head, run.truth, row);
}

struct OddKind {
  std::string name;
  std::function<Recording(const Robot&)> make;
  std::vector<Kind> refused = {};  // one of these; empty: the factors are right
};

void swap_wheels(WheelsAt& at) { std::swap(at.left_m, at.right_m); }
void reverse_wheels(WheelsAt& at) { at.left_m = -at.left_m, at.right_m = -at.right_m; }

/// Counts after a fault of wiring, with what a person says about it.
Recording wired(const Robot& robot, const std::function<void(WheelsAt&)>& fault, bool swapped,
                bool reversed) {
  Recording recording = robot.with([&](const Trajectory& run) { return counts_in(changed(run, fault)); });
  recording.choices.wheels.exchanged = swapped;
  recording.choices.wheels.reversed = reversed;
  return recording;
}

Recording with_wheelbase(const Robot& robot, double wheelbase_m) {
  Recording recording = robot.with([](const Trajectory& run) { return counts_in(run); });
  recording.choices.geometry.wheelbase_m = wheelbase_m;
  return recording;
}

/// The time by which a clock that was set anew steps in these samples, at a moment that differs from drive to drive.
template <class Samples>
void step_clock(Samples& samples, double by_s) {
  const double from_s = samples.front().time_s + 5 + static_cast<double>(samples.size() % 17);
  for (auto& at : samples) at.time_s += at.time_s > from_s ? by_s : 0;
}

/// Samples that wait for a link: each comes at the end of the stall in which it falls, one after the other.
struct Link {
  double longest_stall_s = 0.36, stalled = 0.35;  // the part of the stalls among all spans
  double every_s = 0;                             // instead, the link sends all that it has in such steps
  double apart_s = 3e-4;                          // in a burst
  double lost = 0;                                // part of the samples

  template <class Samples>
  void send(Samples& samples) const {
    std::mt19937_64 random(samples.size());
    std::uniform_real_distribution<double> even(0, 1);
    double open_s = samples.front().time_s, last_s = -HUGE_VAL;
    bool stalls = false;
    Samples sent;
    for (auto at : samples) {
      while (open_s < at.time_s) {
        stalls = every_s > 0 || even(random) < stalled;
        open_s += every_s > 0 ? every_s : stalls ? longest_stall_s * even(random) : 0.05;
      }
      if (even(random) < lost) continue;
      last_s = at.time_s = std::max(stalls ? open_s : at.time_s, last_s + apart_s);
      sent.push_back(at);
    }
    samples = std::move(sent);
  }
};

std::vector<OddKind> odd_kinds() {
  const auto wheels = [](std::function<std::string(const Trajectory&)> text) {
    return [=](const Robot& robot) { return robot.with(text); };
  };
  const auto truth = [](std::function<std::string(const Trajectory&)> text) {
    return [=](const Robot& robot) {
      return robot.with([](const Trajectory& run) { return counts_in(run); }, text);
    };
  };
  const auto table = [](WheelTable stated, std::function<std::string(const Trajectory&)> text) {
    return [=](const Robot& robot) {
      Recording recording = robot.with(text);
      recording.choices.wheels.table = stated;
      return recording;
    };
  };
  const auto every = [](std::size_t n) {
    return [=](const Trajectory& run) { return counts_in(every_nth(run, n)); };
  };
  const auto speeds = [](const char* head, double per_metre) {
    return [=](const Trajectory& run) {
      std::string text = head;
      for (std::size_t i = 1; i + 1 < run.wheels.size(); ++i) {
        const WheelsAt &a = run.wheels[i - 1], &b = run.wheels[i + 1];
        const double per_s = per_metre / (b.time_s - a.time_s);
        text += fmt::format("{:.6f},{:.9f},{:.9f}\n", run.wheels[i].time_s, per_s * (b.left_m - a.left_m),
                            per_s * (b.right_m - a.right_m));
      }
      return text;
    };
  };
  const auto noisy_positions = [](double sigma_m, std::size_t n) {
    return [=](const Trajectory& run) {
      std::mt19937_64 random(run.truth.size());
      std::normal_distribution<double> normal(0, sigma_m);
      std::string text = "time_s,x_m,y_m\n";
      for (std::size_t i = 0; i < run.truth.size(); i += n)
        text += fmt::format("{:.6f},{:.4f},{:.4f}\n", run.truth[i].time_s, run.truth[i].x_m + normal(random),
                            run.truth[i].y_m + normal(random));
      return text;
    };
  };
  constexpr double kDegree = 180 / std::numbers::pi;
  using Doubt = ImportProblem;
  std::vector<OddKind> kinds{
      {"as it should be", wheels([](auto& run) { return counts_in(run); })},
      {"header in camel case, whole milliseconds", wheels([](auto& run) {
         return rows("timeMs,encoderLeft,encoderRight\n", run.wheels, [](auto& at) {
           return fmt::format("{:.0f},{},{}", 1000 * at.time_s, Robot::counts(at.left_m),
                              Robot::counts(at.right_m));
         });
       })},
      {"semicolons and decimal commas", wheels([](auto& run) { return with_commas(counts_in(run)); })},
      {"sep=; as a spreadsheet saves it",
       wheels([](auto& run) { return "sep=;\n" + with_commas(counts_in(run)); })},
      {"tabs, Windows line ends, a mark", wheels([](auto& run) {
         std::string text = "\xEF\xBB\xBF";
         for (const char c : counts_in(run))
           text += c == ',' ? std::string("\t") : c == '\n' ? "\r\n" : std::string(1, c);
         return text;
       })},
      {"blanks under a comment with the names", wheels([](auto& run) {
         std::string text = counts_in(run, "# time_s,left_counts,right_counts\n");
         std::replace(text.begin(), text.end(), ',', ' ');
         return text;
       })},
      {"UTF-16", wheels([](auto& run) { return utf16(counts_in(run)); })},
      {"quotes round each cell", wheels([](auto& run) {
         return rows("\"time_s\",\"left_counts\",\"right_counts\"\n", run.wheels, [](auto& at) {
           return fmt::format("\"{:.6f}\",\"{}\",\"{}\"", at.time_s, Robot::counts(at.left_m),
                              Robot::counts(at.right_m));
         });
       })},
      {"a title, blank lines and comments",
       wheels([](auto& run) { return "Log of robot 5\n\n" + counts_in(run) + "# end\n"; })},
      {"a line of units under the names",
       wheels([](auto& run) { return counts_in(run, "t,left wheel,right wheel\ns,ticks,ticks\n"); })},
      {"no names, but stated",
       table({.columns = "time_s,left_counts,right_counts"}, [](auto& run) { return counts_in(run, ""); })},
      {"no names and nothing stated",
       wheels([](auto& run) { return counts_in(run, ""); }),
       {WheelProblem::columns_unclear}},
      {"names that say nothing, but stated", table({.columns = "a=time_s,b=left_counts,c=right_counts"},
                                                   [](auto& run) { return counts_in(run, "a,b,c\n"); })},
      {"names that say nothing",
       wheels([](auto& run) { return counts_in(run, "a,b,c\n"); }),
       {WheelProblem::columns_unclear}},
      {"decimal commas between commas",
       wheels([](auto& run) {
         return rows("time_s,left_rad,right_rad\n", run.wheels, [](auto& at) {
           std::string row = fmt::format("{:.6f},{:.6f},{:.6f}", at.time_s, Robot::radians(at.left_m),
                                         Robot::radians(at.right_m));
           std::replace(row.begin(), row.end(), '.', ',');
           return row;
         });
       }),
       {tables::TableProblem::rows_of_other_length}},
      {"dates", wheels([](auto& run) {
         return rows("stamp,left_counts,right_counts\n", run.wheels, [](auto& at) {
           return fmt::format("2024-05-01T{}Z,{},{}", clock_time(36'000 + at.time_s),
                              Robot::counts(at.left_m), Robot::counts(at.right_m));
         });
       })},
      {"times of day over midnight", wheels([](auto& run) {
         return rows("time,left_counts,right_counts\n", run.wheels, [](auto& at) {
           return fmt::format("{},{},{}", clock_time(86'390 + at.time_s), Robot::counts(at.left_m),
                              Robot::counts(at.right_m));
         });
       })},
      {"seconds and nanoseconds apart", wheels([](auto& run) {
         return rows("header.stamp.sec,header.stamp.nanosec,left_encoder,right_encoder\n", run.wheels,
                     [](auto& at) {
                       const long long us = 1'700'000'000'000'000 + std::llround(1e6 * at.time_s);
                       return fmt::format("{},{},{},{}", us / 1'000'000, 1000 * (us % 1'000'000),
                                          Robot::counts(at.left_m), Robot::counts(at.right_m));
                     });
       })},
      {"seconds and milliseconds apart", wheels([](auto& run) {
         return rows("sec,msec,left_encoder,right_encoder\n", run.wheels, [](auto& at) {
           const long long ms = 1'700'000'000'000 + std::llround(1e3 * at.time_s);
           return fmt::format("{},{},{},{}", ms / 1000, ms % 1000, Robot::counts(at.left_m),
                              Robot::counts(at.right_m));
         });
       })},
      {"seconds and microseconds apart", wheels([](auto& run) {
         return rows("tv_usec,left_encoder,right_encoder,tv_sec\n", run.wheels, [](auto& at) {
           const long long us = 1'700'000'000'000'000 + std::llround(1e6 * at.time_s);
           return fmt::format("{},{},{},{}", us % 1'000'000, Robot::counts(at.left_m),
                              Robot::counts(at.right_m), us / 1'000'000);
         });
       })},
      {"whole seconds with a hundred rows in each",
       wheels([=](auto& run) { return counts_at(run, "time", [](double t) { return std::floor(t); }); })},
      {"tenths of a second with ten rows in each", wheels([=](auto& run) {
         return counts_at(run, "time_s", [](double t) { return std::floor(10 * t) / 10; });
       })},
      {"dates of whole seconds", wheels([](auto& run) {
         return rows("stamp,left_counts,right_counts\n", run.wheels, [](auto& at) {
           return fmt::format("2024-05-01 {},{},{}", clock_time(36'000 + at.time_s).substr(0, 8),
                              Robot::counts(at.left_m), Robot::counts(at.right_m));
         });
       })},
      {"whole seconds with many or few rows in each",
       wheels([=](auto& run) {
         std::mt19937_64 random(7);
         Trajectory lossy = run;
         bool lost = false;
         std::size_t i = 0;
         std::erase_if(lossy.wheels, [&](const WheelsAt&) {
           if (i++ % 40 == 0) lost = random() % 2 == 0;
           return lost;
         });
         return counts_at(lossy, "time", [](double t) { return std::floor(t); });
       }),
       {WheelTableProblem::times_too_coarse}},
      {"each row twice", wheels([](auto& run) {
         return rows("time_s,left_counts,right_counts\n", run.wheels, [](auto& at) {
           const std::string row =
               fmt::format("{:.6f},{},{}", at.time_s, Robot::counts(at.left_m), Robot::counts(at.right_m));
           return row + "\n" + row;
         });
       })},
      {"truth with whole seconds", truth([](auto& run) {
         return truth_in(run, "time_s,x_m,y_m,theta_rad\n", [](auto& at) {
           return fmt::format("{:.0f},{:.6f},{:.6f},{:.6f}", std::floor(at.time_s), at.x_m, at.y_m,
                              at.theta_rad);
         });
       })},
      {"microseconds that are not called so", wheels([](auto& run) {
         return rows("time,left_ticks,right_ticks\n", run.wheels, [](auto& at) {
           return fmt::format("{:.0f},{},{}", 1e6 * (5 + at.time_s), Robot::counts(at.left_m),
                              Robot::counts(at.right_m));
         });
       })},
      {"nanoseconds since 1970 that are not called so", wheels([](auto& run) {
         return rows("timestamp,l_enc,r_enc\n", run.wheels, [](auto& at) {
           return fmt::format("{},{},{}", 1'700'000'000'000'000'000 + std::llround(1e9 * at.time_s),
                              Robot::counts(at.left_m), Robot::counts(at.right_m));
         });
       })},
      {"hundredths of a second that are not called so",
       wheels([=](auto& run) {
         return counts_at(every_nth(run, 2), "time", [](double t) { return std::round(100 * t); });
       }),
       {Doubt::time_unit_doubtful}},
      {"numbers of frames as times of the truth",
       truth([](auto& run) {
         int frame = 0;
         return truth_in(run, "t,x_m,y_m,theta_rad\n", [&](auto& at) {
           return fmt::format("{},{:.6f},{:.6f},{:.6f}", frame++, at.x_m, at.y_m, at.theta_rad);
         });
       }),
       {Doubt::time_unit_doubtful}},
      {"milliseconds of 16 bits", wheels([=](auto& run) {
         return counts_at(run, "time_ms",
                          [](double t) { return std::fmod(std::round(1000 * (60 + t)), 65'536); });
       })},
      {"microseconds of 32 bits", wheels([=](auto& run) {
         return counts_at(run, "micros",
                          [](double t) { return std::fmod(std::round(1e6 * (4'290 + t)), 4'294'967'296); });
       })},
      {"thousands marked by points beside decimal commas", wheels([](auto& run) {
         return rows("time_s;left_counts;right_counts\n", run.wheels, [](auto& at) {
           const auto grouped = [](double count) {
             std::string digits = fmt::format("{:.0f}", count);
             for (auto place = static_cast<std::ptrdiff_t>(digits.size()) - 3; place > 0; place -= 3)
               digits.insert(static_cast<std::size_t>(place), 1, '.');
             return digits;
           };
           std::string time = fmt::format("{:.3f}", at.time_s);
           std::replace(time.begin(), time.end(), '.', ',');
           return fmt::format("{};{};{}", time, grouped(100'000 + Robot::counts(at.left_m)),
                              grouped(100'000 + Robot::counts(at.right_m)));
         });
       })},
      {"angles in degrees", wheels([=](auto& run) {
         return rows("time_s,left_deg,right_deg\n", run.wheels, [=](auto& at) {
           return fmt::format("{:.6f},{:.6f},{:.6f}", at.time_s, kDegree * Robot::radians(at.left_m),
                              kDegree * Robot::radians(at.right_m));
         });
       })},
      {"angles within one turn", wheels([](auto& run) {
         return rows("time_s,wl_rad,wr_rad\n", run.wheels, [](auto& at) {
           return fmt::format("{:.6f},{:.6f},{:.6f}", at.time_s,
                              std::remainder(Robot::radians(at.left_m), 2 * std::numbers::pi),
                              std::remainder(Robot::radians(at.right_m), 2 * std::numbers::pi));
         });
       })},
      {"travel in millimetres", wheels([](auto& run) {
         return rows("time_s,Left (mm),Right (mm)\n", run.wheels, [](auto& at) {
           return fmt::format("{:.6f},{:.4f},{:.4f}", at.time_s, 1e3 * at.left_m, 1e3 * at.right_m);
         });
       })},
      {"speeds in rad/s", wheels(speeds("time_s,wl_rad_s,wr_rad_s\n", Robot::radians(1)))},
      {"speeds in turns a minute",
       wheels(speeds("time_s,left_rpm,right_rpm\n", Robot::radians(1) * 60 / (2 * std::numbers::pi)))},
      {"speeds in m/s", wheels(speeds("time_s,left_mps,right_mps\n", 1))},
      {"speeds whose unit nobody says",
       wheels(speeds("time_s,left_vel,right_vel\n", 1)),
       {WheelProblem::columns_unclear}},
      {"commands beside what was measured", wheels([](auto& run) {
         return rows("time_s,left_cmd_rad,right_cmd_rad,left_counts,right_counts,left_pwm\n", run.wheels,
                     [](auto& at) {
                       return fmt::format("{:.6f},1,1,{},{},40", at.time_s, Robot::counts(at.left_m),
                                          Robot::counts(at.right_m));
                     });
       })},
      {"travel per interval, stated",
       [](const Robot& robot) {
         Recording recording = robot.recording();
         const Recording plain = robot.with([](const Trajectory& run) {
           double left = 0, right = 0;
           return rows("time_s,left_counts,right_counts\n", run.wheels, [&](const WheelsAt& at) {
             const double l = Robot::counts(at.left_m), r = Robot::counts(at.right_m);
             return fmt::format("{:.6f},{},{}", at.time_s, l - std::exchange(left, l),
                                r - std::exchange(right, r));
           });
         });
         recording.files = plain.files;
         recording.choices.wheels.table.per_interval = true;
         return recording;
       }},
      {"travel per interval, forgotten",
       wheels([](auto& run) {
         double left = 0, right = 0;
         return rows("time_s,left_counts,right_counts\n", run.wheels, [&](const WheelsAt& at) {
           const double l = Robot::counts(at.left_m), r = Robot::counts(at.right_m);
           return fmt::format("{:.6f},{},{}", at.time_s, l - std::exchange(left, l),
                              r - std::exchange(right, r));
         });
       }),
       {Doubt::per_interval_likely}},
      {"four wheels", wheels([](auto& run) {
         return rows("time_s,FL,FR,RL,RR\n", run.wheels, [](auto& at) {
           const double l = Robot::counts(at.left_m), r = Robot::counts(at.right_m);
           return fmt::format("{:.6f},{},{},{},{}", at.time_s, std::round(1.002 * l), std::round(0.999 * r),
                              std::round(0.998 * l), std::round(1.001 * r));
         });
       })},
      {"a counter of 16 bits", wheels([](auto& run) { return counts_around(run, 65'536); })},
      {"a counter of 12 bits", wheels([](auto& run) { return counts_around(run, 4'096); })},
      {"a counter of 12 bits at 10 Hz",
       [](const Robot& robot) { return slow_counters(robot, 4'096, 1, 10); }},
      {"a counter of 12 bits at 5 Hz", [](const Robot& robot) { return slow_counters(robot, 4'096, 1, 20); }},
      {"a counter of 8 bits at 20 Hz", [](const Robot& robot) { return slow_counters(robot, 256, 16, 5); }},
      {"a counter of 8 bits at 10 Hz", [](const Robot& robot) { return slow_counters(robot, 256, 16, 10); }},
      {"a counter of 8 bits at 10 Hz, nearly half a range a row",
       [](const Robot& robot) { return slow_counters(robot, 256, 6, 10); }},
      {"a counter of 16 bits at 2 Hz",
       [](const Robot& robot) { return slow_counters(robot, 65'536, 0.125, 50); }},
      {"a counter of 8 bits that comes round within two rows",
       [](const Robot& robot) { return slow_counters(robot, 256, 2, 10); },
       {CounterProblem::too_fast}},
      {"a counter of 10 bits", wheels([](auto& run) { return counts_around(run, 1'024); })},
      {"a counter from 0 to 8999 that the first drive does not show",
       [](const Robot& robot) { return slow_counters(robot, 9'000, 1, 1, 50); }},
      {"a counter from 0 to 8999", wheels([](auto& run) { return counts_around(run, 9'000); })},
      {"a counter of an odd range",
       wheels([](auto& run) { return counts_around(run, 7'919); }),
       {CounterProblem::range_unknown}},
      {"a counter of an odd range, stated",
       table({.counter_range = 7'919}, [](auto& run) { return counts_around(run, 7'919); })},
      {"a reset on the way", wheels([](auto& run) {
         Trajectory again = run;
         const std::size_t from = again.wheels.size() / 3;
         const WheelsAt at = again.wheels[from];
         for (std::size_t i = from; i < again.wheels.size(); ++i) {
           again.wheels[i].left_m -= at.left_m;
           again.wheels[i].right_m -= at.right_m;
         }
         return counts_in(again);
       })},
      {"zeros before the counters were read", wheels([](auto& run) {
         return "time_s,left_counts,right_counts\n-1,0,0\n" +
                counts_in(changed(run, [](WheelsAt& at) { at.left_m += 7, at.right_m += 8; }), "");
       })},
      {"half a second lost twice",
       wheels([](auto& run) { return counts_in(without(without(run, 9, 9.5), 20, 20.5)); })},
      {"a log of 5 Hz", wheels(every(20))},
      {"a log of 2 Hz", wheels(every(50))},
      {"a log of 1 Hz", wheels(every(100))},
      {"left and right exchanged",
       [](const Robot& robot) { return wired(robot, swap_wheels, false, false); },
       {Doubt::turns_against_wheels}},
      {"left and right exchanged, stated",
       [](const Robot& robot) { return wired(robot, swap_wheels, true, false); }},
      {"left and right exchanged, taken for reversed",
       [](const Robot& robot) { return wired(robot, swap_wheels, false, true); },
       {Doubt::drives_backward}},
      {"encoders reversed",
       [](const Robot& robot) { return wired(robot, reverse_wheels, false, false); },
       {Doubt::encoders_reversed}},
      {"encoders reversed, stated",
       [](const Robot& robot) { return wired(robot, reverse_wheels, false, true); }},
      {"encoders reversed, taken for exchanged",
       [](const Robot& robot) { return wired(robot, reverse_wheels, true, false); },
       {Doubt::drives_backward}},
      {"exchanged and reversed",
       [](const Robot& robot) {
         return wired(
             robot, [](WheelsAt& at) { swap_wheels(at), reverse_wheels(at); }, false, false);
       },
       {Doubt::drives_backward}},
      {"a joint that turns backward, by its multiplier",
       [](const Robot& robot) {
         Recording recording = wired(
             robot, [](WheelsAt& at) { at.right_m = -at.right_m; }, false, false);
         recording.choices.geometry.right_backward = true;
         return recording;
       }},
      {"half the wheelbase stated",
       [=](const Robot& robot) { return with_wheelbase(robot, Robot::kWheelbase_m / 2); },
       {calibration::LikelihoodProblem::wheelbase_unlike}},
      {"twice the wheelbase stated",
       [=](const Robot& robot) { return with_wheelbase(robot, 2 * Robot::kWheelbase_m); },
       {calibration::LikelihoodProblem::wheelbase_unlike}},
      {"one encoder twice",
       [](const Robot& robot) {
         return wired(
             robot, [](WheelsAt& at) { at.right_m = at.left_m; }, false, false);
       },
       {Doubt::wheels_equal}},
      {"a dead encoder",
       [](const Robot& robot) {
         return wired(
             robot, [](WheelsAt& at) { at.right_m = 0; }, false, false);
       },
       {Doubt::wheel_stands}},
      {"truth saved again by a spreadsheet", truth([](auto& run) {
         return with_commas(truth_in(run, "Time (s),X (mm),Y (mm),Yaw (deg)\n", [](auto& at) {
           return fmt::format("{:.6f},{:.3f},{:.3f},{:.4f}", at.time_s, 1e3 * at.x_m, 1e3 * at.y_m,
                              180 / std::numbers::pi * at.theta_rad);
         }));
       })},
      {"headings in degrees that are not called so", truth([=](auto& run) {
         return truth_in(run, "time_s,x_m,y_m,heading\n", [=](auto& at) {
           return fmt::format("{:.6f},{:.6f},{:.6f},{:.4f}", at.time_s, at.x_m, at.y_m,
                              kDegree * std::remainder(at.theta_rad, 2 * std::numbers::pi));
         });
       })},
      {"roll, pitch and yaw of a tag, with its number", truth([](auto& run) {
         return truth_in(run, "timestamp,tag_id,x,y,z,roll,pitch,yaw\n", [](auto& at) {
           return fmt::format("{:.6f},7,{:.6f},{:.6f},0.2,0,0,{:.6f}", 1.7e9 + at.time_s, at.x_m, at.y_m,
                              std::remainder(at.theta_rad, 2 * std::numbers::pi));
         });
       })},
      {"positions of 1 cm at 10 Hz", truth(noisy_positions(0.01, 6))},
      {"positions of 5 cm at 5 Hz", truth(noisy_positions(0.05, 12))},
      {"a marker that jumps for 0.2 s", truth([](auto& run) {
         return truth_in(run, "time_s,x_m,y_m,theta_rad\n", [](auto& at) {
           const bool jumps = at.time_s > 12 && at.time_s < 12.2;
           return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f}", at.time_s, at.x_m + (jumps ? 0.25 : 0), at.y_m,
                              at.theta_rad);
         });
       })},
      {"truth of headings clockwise from north", truth([=](auto& run) {
         return truth_in(run, "time_s,x_m,y_m,heading_deg\n", [=](auto& at) {
           return fmt::format(
               "{:.6f},{:.6f},{:.6f},{:.4f}", at.time_s, at.x_m, at.y_m,
               kDegree * std::remainder(std::numbers::pi / 2 - at.theta_rad, 2 * std::numbers::pi));
         });
       })},
      {"truth with a header only",
       truth([](auto&) { return std::string("time_s,x_m,y_m,theta_rad\n"); }),
       {Doubt::no_poses}},
      {"truth of one pose",
       truth([](auto&) { return std::string("time_s,x_m,y_m,theta_rad\n0,0,0,0\n"); }),
       {Doubt::no_poses}},
      {"truth whose columns are stated",
       [](const Robot& robot) {
         Recording recording = robot.with([](const Trajectory& run) { return counts_in(run); },
                                          [](const Trajectory& run) {
                                            return truth_in(run, "", [](auto& at) {
                                              return fmt::format("{:.6f} {:.6f} {:.6f} {:.6f}", at.time_s,
                                                                 at.x_m, at.y_m, at.theta_rad);
                                            });
                                          });
         recording.choices.truth.columns = "time_s,x_m,y_m,theta_rad";
         return recording;
       }},
  };
  const auto drives = [&](const std::string& name, std::function<void(Trajectory&)> change,
                          std::vector<Kind> refused = {}) {
    kinds.push_back({name,
                     [=](const Robot& robot) {
                       Robot other = robot;
                       for (Trajectory& run : other.drives) change(run);
                       return other.with([](const Trajectory& run) { return counts_in(run); });
                     },
                     std::move(refused)});
  };
  for (const double by_s : {0.1, -0.1, 0.2, -0.2, 0.5, -0.5, 1.0, -1.0}) {
    drives(fmt::format("the wheels' clock steps by {} s", by_s),
           [=](Trajectory& run) { step_clock(run.wheels, by_s); });
    drives(fmt::format("the tracker's clock steps by {} s", by_s),
           [=](Trajectory& run) { step_clock(run.truth, by_s); });
  }
  const auto cut = [](auto& samples) {
    const double first_s = samples.front().time_s, span_s = samples.back().time_s - first_s;
    std::erase_if(samples, [=](const auto& at) {
      return at.time_s < first_s + 0.15 * span_s || at.time_s > first_s + 0.9 * span_s;
    });
  };
  drives("wheels that begin and end while the robot moves", [=](Trajectory& run) { cut(run.wheels); });
  drives("ground truth that begins and ends while the robot moves", [=](Trajectory& run) { cut(run.truth); });
  const std::pair<const char*, Link> links[] = {
      {"a link that stalls", {}},
      {"a link that stalls, stamps in ms", {.apart_s = 0}},
      {"a link that stalls and loses 3 %", {.lost = 0.03}},
      {"a link that sends every 0.1 s", {.every_s = 0.1}},
      {"a link that sends every 0.3 s", {.every_s = 0.3}},
  };
  for (const auto& [name, link] : links) {
    drives(fmt::format("wheels over {}", name), [link = link](Trajectory& run) { link.send(run.wheels); });
    drives(fmt::format("ground truth over {}", name),
           [link = link](Trajectory& run) { link.send(run.truth); });
  }
  return kinds;
}

TEST(OddRecordings, GiveTheRightFactorsOrAreRefusedForTheirReason) {
  constexpr double kSigmas = 3;
  const std::vector<OddKind> kinds = odd_kinds();
  EXPECT_GE(kinds.size(), 40U);
  for (const OddKind& kind : kinds) {
    const test::TemporaryFolder folder;
    const Robot robot(folder.path());
    const calibration::WheelFactors& right = robot.model.actual;
    const Recording recording = kind.make(robot);
    try {
      const experiment::Calibration found = experiment::calibrate(
          import_drives(recording.files, recording.choices).set, {experiment::MethodChoice::Family::ml, {}});
      const double miss = std::max({std::abs(found.factors.c_r - right.c_r) / found.se.c_r,
                                    std::abs(found.factors.c_l - right.c_l) / found.se.c_l,
                                    std::abs(found.factors.b_m - right.b_m) / found.se.b_m});
      std::printf("%-50s right to %.1f standard errors; E_d +- %.5f, b +- %.5f\n", kind.name.c_str(), miss,
                  found.se.E_d, found.se.b_m);
      EXPECT_TRUE(kind.refused.empty()) << kind.name << ": silently taken";
      EXPECT_LT(miss, kSigmas) << kind.name << ": silently wrong";
    } catch (const Error& error) {
      std::printf("%-50s refused: %.120s\n", kind.name.c_str(), error.what());
      EXPECT_THAT(kind.refused, testing::Contains(error.kind())) << kind.name << ": " << error.what();
    }
  }
}

}  // namespace
}  // namespace astro::importing
