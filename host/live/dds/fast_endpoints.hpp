#pragma once

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>

#include "host/live/dds/fast_transport.hpp"
#include "host/live/dds/fast_types.hpp"

/// Writers and readers on Fast DDS. Its threads note what has happened; all else is done by the one thread of the caller.
namespace astro::dds {

/// Endpoints that have found one of ours. Fast DDS reports them in its own threads.
class Matched {
 public:
  void note(const Guid& other, int change) {
    const std::lock_guard lock(mutex_);
    if (change > 0)
      since_.emplace(other, std::chrono::steady_clock::now());
    else
      since_.erase(other);
  }
  std::vector<Guid> all() const {
    return those([](const Guid&, std::chrono::steady_clock::duration) { return true; });
  }
  /// The endpoints for which `chosen` returns true. It is called with each endpoint and the time since it was found.
  template <class Chosen>
  std::vector<Guid> those(Chosen chosen) const {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    std::vector<Guid> guids;
    for (const auto& [guid, since] : since_)
      if (chosen(guid, now - since)) guids.push_back(guid);
    return guids;
  }

 private:
  mutable std::mutex mutex_;
  std::map<Guid, std::chrono::steady_clock::time_point> since_;
};

/// Lets the one thread that uses a participant sleep until something has come.
class Bell {
 public:
  void ring() {
    {
      const std::lock_guard lock(mutex_);
      rung_ = true;
    }
    condition_.notify_one();
  }
  void wait(std::chrono::microseconds timeout) {
    std::unique_lock lock(mutex_);
    condition_.wait_for(lock, timeout, [&] { return rung_; });
    rung_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  bool rung_ = false;
};

/// Throws astro::Error if Fast DDS refuses it. `acknowledged` must outlive it.
///
/// A reader is certain once it has acknowledged a heartbeat: a volatile reader of CycloneDDS regards all samples that the
/// first heartbeat names as older than itself, and never requests them. A reader that is not reliable acknowledges nothing,
/// so every reader is certain after half a second.
class FastWriter : public Writer, fast::DataWriterListener {
 public:
  FastWriter(fast::Publisher& publisher, fast::Topic* topic, const Topic& wanted,
             AcknowledgedBy& acknowledged);
  ~FastWriter() override;
  FastWriter(const FastWriter&) = delete;
  FastWriter& operator=(const FastWriter&) = delete;

  Guid guid() const override { return to_guid(writer_->guid()); }
  std::vector<Guid> readers() const override { return readers_.all(); }
  std::vector<Guid> certain_readers() const override;

 private:
  void send(ByteView payload, const SampleId* related) override;
  void on_publication_matched(fast::DataWriter* writer,
                              const fast::PublicationMatchedStatus& status) override;

  static constexpr std::chrono::milliseconds kWithoutAcknowledgement{500};

  fast::Publisher& publisher_;
  AcknowledgedBy& acknowledged_;
  fast::DataWriter* writer_;
  Matched readers_;
};

/// Throws astro::Error if Fast DDS refuses it. `bell` must outlive it.
class FastReader : public Reader, fast::DataReaderListener {
 public:
  FastReader(fast::Subscriber& subscriber, fast::Topic* topic, const Topic& wanted, Bell& bell);
  ~FastReader() override;
  FastReader(const FastReader&) = delete;
  FastReader& operator=(const FastReader&) = delete;

  std::vector<Sample> take() override;
  Guid guid() const override { return to_guid(reader_->guid()); }
  std::vector<Guid> writers() const override { return writers_.all(); }

 private:
  void on_data_available(fast::DataReader*) override { bell_.ring(); }
  void on_subscription_matched(fast::DataReader*, const fast::SubscriptionMatchedStatus& status) override;

  fast::Subscriber& subscriber_;
  Bell& bell_;
  fast::DataReader* reader_;
  Matched writers_;
};

}  // namespace astro::dds
