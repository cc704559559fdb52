#pragma once

#include <array>
#include <chrono>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/bytes.hpp"

/// What a ROS 2 node needs from DDS: writers and readers of opaque payloads, and who else is there. Payloads are CDR with
/// their encapsulation header (host/formats/cdr). One thread uses all of it; what the network brings waits until it is taken.
namespace astro::dds {

/// The identifier of an endpoint or a participant, as DDSI-RTPS numbers them: 12 bytes of the participant, 4 of the entity.
struct Guid {
  std::array<std::uint8_t, 16> bytes{};

  auto operator<=>(const Guid&) const = default;
};

/// One sample of one writer.
struct SampleId {
  Guid writer;
  std::int64_t number = 0;

  auto operator<=>(const SampleId&) const = default;
};

struct Qos {
  bool reliable = true;
  bool transient_local = false;  // whoever comes later gets the last `depth` samples
  int depth = 10;                // samples that are kept; 0: all, up to 5000
};

struct Topic {
  std::string name, type;  // as on the wire: "rt/odom", "nav_msgs::msg::dds_::Odometry_"
  Qos qos{};
  std::string user_data{};  // of the endpoint, shown to all others
};

struct Sample {
  Bytes payload;
  SampleId id;
  std::optional<SampleId> related;  // what the writer says that it answers
};

/// A writer or a reader of somebody else, as it has announced itself.
struct RemoteEndpoint {
  Guid guid;
  bool writes = false;
  std::string topic, type;
};

class Writer {
 public:
  virtual ~Writer() = default;

  /// Blocks no longer than the system takes to send.
  void write(ByteView payload) { send(payload, nullptr); }
  /// `related`: what a reply answers, in the manner of rmw_fastrtps.
  void write(ByteView payload, const SampleId& related) { send(payload, &related); }

  virtual Guid guid() const = 0;
  /// Those that read this topic. They come and go by themselves.
  virtual std::vector<Guid> readers() const = 0;
  /// Those of them that are known to have found this writer, or have had the time to, so that what is written now reaches
  /// them. For a reader with best effort only the time decides.
  virtual std::vector<Guid> certain_readers() const { return readers(); }

 private:
  virtual void send(ByteView payload, const SampleId* related) = 0;
};

class Reader {
 public:
  virtual ~Reader() = default;

  /// The most samples of one take(), so that a writer that never pauses does not block its reader.
  static constexpr std::size_t kMostAtOnce = 1000;

  /// What has come since the last call, oldest first. If more than kMostAtOnce has come, wait() does not wait for the rest.
  virtual std::vector<Sample> take() = 0;

  virtual Guid guid() const = 0;
  virtual std::vector<Guid> writers() const = 0;
};

/// Writers and readers must not outlive it.
class Participant {
 public:
  virtual ~Participant() = default;

  /// Throws astro::Error if DDS refuses it.
  virtual std::unique_ptr<Writer> create_writer(const Topic& topic) = 0;
  virtual std::unique_ptr<Reader> create_reader(const Topic& topic) = 0;

  virtual Guid guid() const = 0;
  /// The endpoints of others that are known now, of any topic. It takes a moment after the start until they are known.
  virtual std::vector<RemoteEndpoint> remote_endpoints() const = 0;
  /// The user data of somebody else's endpoint; "" if the endpoint is not known, or shows no user data or implausibly much.
  virtual std::string user_data_of(const Guid& endpoint) const = 0;
  /// Waits until a sample has come to any reader, or until the time is over.
  virtual void wait(std::chrono::microseconds timeout) = 0;
};

}  // namespace astro::dds
