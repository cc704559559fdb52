#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "host/live/dds/participant.hpp"
#include "host/live/driver/middleware.hpp"

/// The two ways in which ROS 2 calls services over DDS, which do not understand each other:
///
///   rmw_fastrtps    the message alone; which reader waits for the reply, and for which request, is carried beside the payload
///   rmw_cyclonedds  16 bytes in front of the message, a client's number and the request's, which the reply repeats; the
///                   client's two endpoints show the same "clientid=...;"
///
/// Source  rmw_fastrtps_shared_cpp: rmw_request.cpp, rmw_response.cpp; rmw_cyclonedds_cpp: serdata.cpp, rmw_node.cpp.
namespace astro::live {

/// A client that uses rmw_fastrtps. `id.writer` is its reader of replies, or its writer of requests if it is an old client,
/// which does not state its reader.
struct FastCaller {
  dds::SampleId id;
};

/// A client that uses rmw_cyclonedds.
struct CycloneCaller {
  std::string client_id;  // as its endpoints show it
  std::uint64_t client = 0;
  std::int64_t number = 0;
};

/// The value of "key=value;" in an endpoint's user data, "" if there is none.
std::string value_in(std::string_view user_data, std::string_view key);

/// A service for clients of either kind. It has one reader and one writer, because clients of both kinds wait until there are
/// as many readers of requests as writers of replies.
///
/// A request is carried out when it comes. Its reply waits until the client's reader of replies has been found, because a
/// reply that is written earlier does not reach it. A client whose reader is not found within kHeldFor gets no reply.
class Service {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kHeldFor{2};
  static constexpr std::size_t kMostHeld = 100;  // beyond that the oldest is dropped
  static constexpr int kDepth = 100;             // requests or replies that wait in DDS

  /// `id` distinguishes this pair of reader and writer from others. `participant` must outlive the service.
  Service(dds::Participant& participant, const ServiceDescription& service, const std::string& id,
          Middleware::OnRequest on_request);

  /// Answers what has come, and sends the replies that can be sent.
  void poll(Clock::time_point now);

  /// The same step by step, so that something else can be done between two requests, each of which may take long.
  void collect();
  /// Answers one request that was collected. False if none can be answered now.
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
  std::unique_ptr<dds::Writer> writer_;  // before the reader, so that who finds the reader gets an answer
  std::unique_ptr<dds::Reader> reader_;
  std::deque<dds::Sample> waiting_;  // collected
  std::deque<Reply> held_;
  bool urgent_;
  std::function<bool()> may_answer_;
};

}  // namespace astro::live
