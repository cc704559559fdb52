#pragma once

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/support/programs/program.hpp"
#include "tests/support/ros2/domain.hpp"
#include "tests/support/ros2/peer_program.hpp"

namespace astro::support {

/// A simulated robot in real time, `astrolabe ros2`, and peers.
class RobotAmongPeers : public testing::Test {
 protected:
  RobotAmongPeers() { start_node(); }

  void start_node(const std::vector<std::string>& options = {}, const std::string& cmd_vel_type = "both") {
    node_.reset();
    const std::string at = node_port_.empty() ? port() : node_port_;
    std::vector<std::string> words{
        ASTROLABE_PROGRAM, "ros2",      "--port", at, "--domain", std::to_string(test_domain()),
        "--cmd-vel",       cmd_vel_type};
    words.insert(words.end(), options.begin(), options.end());
    node_ = std::make_unique<Program>(words);
  }
  void start_robot() {
    robot_ = std::make_unique<Program>(
        std::vector<std::string>{ASTROLABE_PROGRAM, "sim", "--pty", port(), "--slip", "0"});
  }
  std::string port() const { return (folder_.path() / "robot.pty").string(); }

  /// Of the kinds that this build has.
  static std::vector<PeerKind> kinds() {
    std::vector<PeerKind> all{PeerKind::fast};
    if (!path_of(PeerKind::cyclone).empty()) all.push_back(PeerKind::cyclone);
    return all;
  }

  /// Tells the peer something and returns the line that answers it; "" if none comes.
  static std::string ask(PeerProgram& peer, const std::string& command, const std::string& beginning) {
    const std::size_t before = peer.lines(beginning).size();
    peer.say(command);
    if (!eventually([&] { return peer.lines(beginning).size() > before; })) {
      ADD_FAILURE() << "no line '" << beginning << "' after '" << command << '\'';
      return "";
    }
    return peer.lines(beginning)[before];
  }
  static std::string call(PeerProgram& peer, const std::string& service) {
    return ask(peer, "call " + service, "reply " + service);
  }
  /// Waits for a message that is later than those that have come.
  static std::string next(PeerProgram& peer, const std::string& topic) {
    const std::size_t before = peer.lines("got " + topic + ' ').size();
    if (!eventually([&] { return peer.lines("got " + topic + ' ').size() > before; })) {
      ADD_FAILURE() << "nothing came on " << topic;
      return "";
    }
    return peer.lines("got " + topic + ' ').back();
  }
  static void subscribe(PeerProgram& peer, const std::string& topic, const std::string& kind) {
    ask(peer, "sub " + topic + ' ' + kind, "subscribed " + topic);
  }

  test::TemporaryFolder folder_;
  std::string node_port_;  // "": the robot's
  std::unique_ptr<Program> robot_, node_;
};

}  // namespace astro::support
