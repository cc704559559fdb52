#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/text/degrees.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/truth/commands.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/truth/live/live_source.hpp"
#include "host/truth/live/tracker_watch.hpp"

namespace astro::commands {
namespace {

using std::chrono::microseconds;
using std::chrono::seconds;

struct WatchOptions {
  std::string address;
  double seconds = 0;  // 0: until Ctrl-C
  bool json = false;
};

/// Uses the link without a source around it, so that a tracker that sends nothing can be watched, too.
class Watch {
 public:
  explicit Watch(const truth::TrackerUrl& url) : link_(truth::open_link(url)), watch_(url.up) {}

  void listen_until(microseconds end) {
    for (microseconds now = truth::LiveSource::steady_now(); now < end && !console::interrupted();
         now = truth::LiveSource::steady_now()) {
      link_->work(now);
      for (const truth::Sighting& sighting : link_->take()) watch_.take(sighting);
      link_->wait(std::chrono::milliseconds(20));
    }
  }
  truth::TrackerReport report() { return watch_.report(truth::LiveSource::steady_now().count()); }
  /// What is being watched, once something has come.
  std::string about() const { return fmt::format("'{}' {}", link_->body(), link_->way()); }
  /// `fact` with the reason why nothing comes, and what would help.
  Remark silence(const std::string& fact) const { return {fmt::format("{}: {}", fact, link_->why_silent())}; }

 private:
  std::unique_ptr<truth::TrackerLink> link_;
  truth::TrackerWatch watch_;
};

std::string place_of(const truth::TrackerReport& report) {
  if (!report.pose) return "not seen";
  return fmt::format("x {:8.4f} m  y {:8.4f} m  {:7.2f} deg", report.pose->x_m, report.pose->y_m,
                     degrees(report.pose->theta_rad));
}

std::string noise_of(const truth::TrackerReport& report) {
  if (!report.rest) return report.pose ? "moves" : "";
  return fmt::format("noise {:.2f} mm {:.3f} deg", 1e3 * report.rest->position_m,
                     degrees(report.rest->heading_rad));
}

/// One line of at most 120 columns.
std::string line_of(const truth::TrackerReport& report) {
  return fmt::format("{:6.1f} Hz  jitter {:.2f}/{:.2f} ms  gap {:.0f} ms  missing {}  lost {}  {}  {}",
                     report.rate_hz, 1e3 * report.sender.jitter_s, 1e3 * report.arrival.jitter_s,
                     1e3 * report.longest_gap_s, report.missing, report.lost, place_of(report),
                     noise_of(report));
}

nlohmann::json json_of(const truth::TrackerReport& report) {
  nlohmann::json json = {{"poses", report.poses},
                         {"lost", report.lost},
                         {"missing", report.missing},
                         {"rate_hz", report.rate_hz},
                         {"longest_gap_s", report.longest_gap_s},
                         {"sender_jitter_s", report.sender.jitter_s},
                         {"arrival_jitter_s", report.arrival.jitter_s},
                         {"pose", nullptr},
                         {"noise_at_rest", nullptr}};
  if (report.pose)
    json["pose"] = {
        {"x_m", report.pose->x_m}, {"y_m", report.pose->y_m}, {"theta_rad", report.pose->theta_rad}};
  if (report.rest)
    json["noise_at_rest"] = {{"position_m", report.rest->position_m},
                             {"heading_rad", report.rest->heading_rad}};
  return json;
}

void run(const WatchOptions& options) {
  const truth::TrackerUrl url = truth::tracker_url_in(options.address);
  Watch watch(url);
  const microseconds begin = truth::LiveSource::steady_now();
  const auto passed = [&] {
    return 1e-6 * static_cast<double>((truth::LiveSource::steady_now() - begin).count());
  };
  bool seen = false, objected = false;
  for (int second = 1; options.seconds == 0 || passed() < options.seconds; ++second) {
    watch.listen_until(begin + second * seconds(1));
    if (console::interrupted()) break;
    const truth::TrackerReport report = watch.report();
    if (report.poses == 0) {
      console::say(in_words(watch.silence("nothing comes from " + url.place())));
      continue;
    }
    if (!std::exchange(seen, true)) console::say(watch.about());
    if (report.objection && !std::exchange(objected, true)) console::say(in_words(*report.objection));
    print(options.json ? json_of(report).dump() : line_of(report));
  }
  if (options.seconds > 0) console::check_interrupt();  // without a time Ctrl-C is how it ends
  if (!seen && !console::interrupted())
    throw Error(watch.silence("no ground truth came from " + url.place()));
}

}  // namespace

void add_truth_watch(console::Command truth) {
  const auto options = std::make_shared<WatchOptions>();
  const console::Command command =
      truth.add_subcommand("watch", "show each second what a tracker sent in the last three");
  command
      .add_option("address", options->address,
                  "vrpn://HOST[:PORT]/BODY, natnet://HOST[:PORT]/BODY or\nros2:/TOPIC, with ?up=y if its y "
                  "axis points up")
      .type_name("URL")
      .required();
  command.add_option("--seconds", options->seconds, "end after this time (default: at Ctrl-C)")
      .type_name("S")
      .check(console::positive("s"));
  add_json_flag(command, options->json);
  command.footer(
      "Hz: frames per second. jitter: of the tracker's own times / of their arrival. gap: the longest\n"
      "without the body. missing: frames that did not come. lost: frames without the body. noise:\n"
      "standard deviation of the position and the heading while the body stands.\n"
      "ros2:/TOPIC has PoseStamped, PoseWithCovarianceStamped, TransformStamped, Odometry or transforms;\n"
      "?child=FRAME names one of several bodies, &parent=FRAME the tracker's frame, &domain=N the ROS\n"
      "domain; &range=subnet looks at other computers, too. ROS_DOMAIN_ID and its like are obeyed.\n"
      "Examples:\n"
      "  astrolabe truth watch vrpn://lab-pc:3883/ASTRO\n"
      "  astrolabe truth watch 'vrpn://lab-pc/ASTRO?up=y' --seconds 10 --json\n"
      "  astrolabe truth watch ros2:/vrpn_mocap/robot/pose\n"
      "  astrolabe truth watch 'ros2:/tf?parent=world&child=robot&range=subnet'");
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
