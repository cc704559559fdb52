#include "host/live/foxglove/server.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <new>

#include "tests/host/live/foxglove/viewer.hpp"

namespace astro::foxglove {
namespace {

using std::chrono::seconds;
using support::SilentConnection;
using support::Viewer;

/// Has no memory left the first time that a notice of this kind comes.
RequestSink failing_once(Kind kind, std::atomic<int>& failures) {
  return [kind, &failures](const Request& request) {
    const auto* notice = std::get_if<NoticeArrived>(&request);
    if (notice == nullptr || notice->remark.kind != kind || failures > 0) return;
    ++failures;
    throw std::bad_alloc();
  };
}

class ServerAndItsHub : public testing::Test {
 protected:
  void start(const RequestSink& sink) {
    server_.emplace(Address{"127.0.0.1", 0}, std::vector<std::string>{},
                    std::make_unique<Hub>("robot", "session", true, sink), sink);
    server_->start();
  }

  std::atomic<int> failures_ = 0;  // outlives the server
  std::optional<Server> server_;
};

TEST_F(ServerAndItsHub, AcceptsViewersAgainWhateverAcceptingOneThrew) {
  start(failing_once(ViewerProblem::idle, failures_));
  std::vector<Viewer> viewers;
  for (int i = 0; i < 64; ++i) viewers.emplace_back(server_->port());
  const SilentConnection one_too_many(server_->port());
  Viewer late(server_->port());
  EXPECT_TRUE(late.receive(seconds(20)));
  EXPECT_EQ(failures_, 1) << "the idlest viewer had to go, and telling so failed";
}

TEST_F(ServerAndItsHub, AFailureThatCannotEvenBeToldEndsNothing) {
  start([this](const Request&) {
    ++failures_;
    throw std::bad_alloc();
  });
  for (int i = 0; i < 3; ++i) {
    Viewer viewer(server_->port());
    EXPECT_TRUE(viewer.receive(seconds(20)));
  }
  EXPECT_GT(failures_, 0);
}

TEST_F(ServerAndItsHub, WorkBehindWorkThatFailsIsDone) {
  start([](const Request&) {});
  std::atomic<bool> done = false;
  server_->post([](Hub&) { throw std::bad_alloc(); });
  server_->post([&](Hub&) {
    done = true;
    done.notify_all();
  });
  done.wait(false);
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace astro::foxglove
