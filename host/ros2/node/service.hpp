#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <variant>

#include "host/ros2/dds/participant.hpp"
#include "host/ros2/middleware/middleware.hpp"
#include "host/ros2/node/request_styles.hpp"

namespace astro::ros2 {

/// A service for clients of either kind (request_styles.hpp), with one reader and one writer, because both kinds wait until as
/// many readers of requests are there as writers of replies.
///
/// A request is carried out when it comes. Its reply waits until the client's reader of replies has been found, for what is
/// written before does not reach it; a client that is not found within kHeldFor gets none.
class Service {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kHeldFor{2};
  static constexpr std::size_t kMostHeld = 100;  // then the oldest goes
  static constexpr int kDepth = 100;             // requests or replies that wait in DDS

  /// `id` tells the pair of reader and writer from others. `participant` must outlive the service.
  Service(dds::Participant& participant, const ServiceDescription& service, const std::string& id,
          Middleware::OnRequest on_request);

  /// Answers what has come, and sends the replies that can be sent.
  void poll(Clock::time_point now);

  /// The same step by step, so that something else can be done between two requests, each of which may take long.
  void collect();
  /// False if nothing of what was collected can be answered now.
  bool answer_next(Clock::time_point now);
  void send_replies(Clock::time_point now);

  bool urgent() const { return urgent_; }

  dds::Guid reader() const { return reader_->guid(); }
  dds::Guid writer() const { return writer_->guid(); }

 private:
  struct Reply {
    std::variant<FastCaller, CycloneCaller> caller;
    Bytes response;
    Clock::time_point until;
  };

  void answer(const dds::Sample& sample, Clock::time_point now);
  bool is_found(const Reply& reply, const std::vector<dds::Guid>& readers) const;
  void send(const Reply& reply);

  dds::Participant& participant_;
  Middleware::OnRequest on_request_;
  std::unique_ptr<dds::Writer> writer_;  // before the reader: who finds the reader will be answered
  std::unique_ptr<dds::Reader> reader_;
  std::deque<dds::Sample> waiting_;  // collected
  std::deque<Reply> held_;
  bool urgent_;
  std::function<bool()> may_answer_;
};

}  // namespace astro::ros2
