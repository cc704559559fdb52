#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "common/protocol/frame.hpp"
#include "common/protocol/framer.hpp"
#include "common/protocol/session.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/links/pty_peer.hpp"
#include "tests/support/programs/program.hpp"

// Text of a robot or a file with control sequences, or that is no UTF-8, is never printed unchanged.
namespace astro {
namespace {

namespace fs = std::filesystem;
using support::astrolabe;
using support::Outcome;
using test::PtyPeer;
using testing::HasSubstr;

constexpr const char* kEvil = "\033]0;x\a\033[2J\x9B\xFF";

void is_plain(const Outcome& outcome) {
  for (const std::string& text : {outcome.out, outcome.err})
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      ASSERT_TRUE(byte >= 0x20 || c == '\n' || c == '\t') << "byte " << int{byte} << " in: " << text;
    }
  EXPECT_NO_THROW(nlohmann::json(outcome.out + outcome.err).dump()) << "what is no UTF-8 cannot be dumped";
}

class ForeignText : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return (folder_.path() / name).string();
  }
  test::TemporaryFolder folder_;
};

TEST_F(ForeignText, OfARobotsNameIsShownWithoutWhatATerminalObeys) {
  protocol::HelloReply hello;
  hello.protocol_version = protocol::kProtocolVersion;
  hello.robot_name = Text<24>(kEvil);
  hello.board = Text<24>(kEvil);
  const PtyPeer robot(
      [hello, framer = std::make_shared<protocol::Framer>()](std::span<const std::uint8_t> bytes) {
        PtyPeer::Bytes out;
        for (const std::uint8_t byte : bytes)
          if (const auto body = framer->push(byte)) {
            const protocol::Frame frame(hello, protocol::peek(*body)->request_id);
            out.insert(out.end(), frame.bytes().begin(), frame.bytes().end());
          }
        return out;
      });
  const fs::path runtime = folder_.path() / ("astrolabe-" + std::to_string(getuid()));
  fs::create_directory(runtime);
  fs::permissions(runtime, fs::perms::owner_all);
  fs::create_symlink(robot.path(), runtime / "evil.pty");
  setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
  const Outcome text = astrolabe({"ports"}), printed = astrolabe({"ports", "--json"});
  unsetenv("XDG_RUNTIME_DIR");
  is_plain(text);
  EXPECT_THAT(text.out, HasSubstr("\uFFFD]0;x\uFFFD\uFFFD[2J"));
  is_plain(printed);
  EXPECT_EQ(support::parse_json(printed.out).at(0).at("robot").at("name").get<std::string>().substr(0, 3),
            "\033]0")
      << "JSON escapes what a program may want to know";
}

TEST_F(ForeignText, OfFilesAndOfTheirNamesIsTold) {
  const std::string good = file("good.csv", "ex_mm,ey_mm\n300,-250\n310,-260\n");
  const auto refused = [&](const std::string& cw) {
    const Outcome outcome = astrolabe(
        {"calibrate", "end-poses", "--cw", cw, "--ccw", good, "--side", "3", "--wheelbase", "0.29"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    is_plain(outcome);
    return outcome.err;
  };
  EXPECT_THAT(refused(file("cell.csv", "ex_mm,ey_mm\n1," + std::string(kEvil) + "\n")),
              HasSubstr("\uFFFD[2J"));
  EXPECT_THAT(refused(folder_.path() / (std::string(kEvil).substr(1) + ".csv")), HasSubstr("does not exist"));
  EXPECT_THAT(refused(folder_.path() / "two\nastrolabe: lines.csv"), HasSubstr("two astrolabe: lines.csv"));
  EXPECT_LT(refused(file("long.csv", "ex_mm,ey_mm\n1," + std::string(5'000'000, 'x') + "\n")).size(), 5000U);
  is_plain(astrolabe({kEvil}));
  is_plain(astrolabe({"info", "--port", kEvil}));
  is_plain(astrolabe(
      {"upload", file("evil.toml", std::string("[parameters]\n\"") + kEvil + "\" = 1\n"), "--port", "/x"}));
}

TEST_F(ForeignText, APathThatTheSystemRefusesIsToldInItsWords) {
  fs::create_symlink("loop", folder_.path() / "loop");
  const std::string loop = folder_.path() / "loop", file = loop + "/x", nobody = "/nowhere";
  const std::string long_name = (folder_.path() / std::string(300, 'x')).string();
  for (const auto& [path, reason] : {std::pair{loop, "Too many levels"}, std::pair{file, "Too many levels"},
                                     std::pair{long_name, "File name too long"}})
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"record", "--port", nobody, "--out", path},
          {"calibrate", "runs", path},
          {"compare", path},
          {"report", path},
          {"upload", path, "--port", nobody},
          {"study", "merge", path},
          {"study", "--trials", "2", "--out", path == loop ? file : path},
          {"flash", path, "--port", nobody},
          {"sim", "--flash", path},
          {"calibrate", "end-poses", "--cw", path, "--ccw", path, "--side", "3", "--wheelbase", "0.29"}}) {
      const Outcome outcome = astrolabe(arguments);
      SCOPED_TRACE(testing::PrintToString(arguments));
      EXPECT_EQ(outcome.code, 1);
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
      EXPECT_THAT(outcome.err, testing::AnyOf(HasSubstr(reason), HasSubstr("is a link"),
                                              HasSubstr("cannot read"), HasSubstr("there is no folder")));
      EXPECT_THAT(outcome.err, testing::Not(HasSubstr("should not have happened")));
    }
}

}  // namespace
}  // namespace astro
