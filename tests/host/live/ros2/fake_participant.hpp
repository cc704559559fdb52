#pragma once

#include <algorithm>
#include <list>
#include <map>
#include <stdexcept>
#include <utility>

#include "host/live/dds/participant.hpp"

namespace astro::dds {

/// A participant without a network: the test puts samples into its readers and sees what its writers have written.
class FakeWire {
  template <class Ends>
  static auto& with_name(Ends& ends, const std::string& topic) {
    const auto found =
        std::find_if(ends.begin(), ends.end(), [&](auto& end) { return end.topic.name == topic; });
    if (found == ends.end()) throw std::runtime_error("nothing of the name " + topic);
    return *found;
  }

 public:
  struct Written {
    Bytes payload;
    std::optional<dds::SampleId> related;
  };
  struct WriterEnd {
    dds::Topic topic;
    dds::Guid guid;
    std::vector<Written> written{};
    std::vector<dds::Guid> readers{};
    bool found = true;  // by all of them
    bool gone = false;
  };
  struct ReaderEnd {
    dds::Topic topic;
    dds::Guid guid;
    std::vector<dds::Sample> waiting{};
  };

  WriterEnd& writer_of(const std::string& topic) { return with_name(writers, topic); }
  ReaderEnd& reader_of(const std::string& topic) { return with_name(readers, topic); }

  std::list<WriterEnd> writers;
  std::list<ReaderEnd> readers;
  std::map<dds::Guid, std::string> user_data;  // of endpoints of others
  std::vector<dds::RemoteEndpoint> others{};
};

/// Of an endpoint: all bytes are `number`, but for the last, its kind.
inline dds::Guid guid_of(std::uint8_t number, std::uint8_t kind) {
  dds::Guid guid;
  guid.bytes.fill(number);
  guid.bytes.back() = kind;
  return guid;
}

inline constexpr std::uint8_t kWriterKind = 0x03, kReaderKind = 0x04, kParticipantKind = 0xC1;

class FakeParticipant : public dds::Participant {
 public:
  explicit FakeParticipant(FakeWire& wire) : wire_(wire) {}

  std::unique_ptr<dds::Writer> create_writer(const dds::Topic& topic) override {
    wire_.writers.push_back({topic, guid_of(next_++, kWriterKind)});
    return std::make_unique<FakeWriter>(wire_.writers.back());
  }
  std::unique_ptr<dds::Reader> create_reader(const dds::Topic& topic) override {
    wire_.readers.push_back({topic, guid_of(next_++, kReaderKind)});
    return std::make_unique<FakeReader>(wire_.readers.back());
  }
  dds::Guid guid() const override { return guid_of(1, kParticipantKind); }
  std::vector<dds::RemoteEndpoint> remote_endpoints() const override { return wire_.others; }
  std::string user_data_of(const dds::Guid& endpoint) const override {
    const auto found = wire_.user_data.find(endpoint);
    return found == wire_.user_data.end() ? "" : found->second;
  }
  void wait(std::chrono::microseconds) override {}

 private:
  class FakeWriter : public dds::Writer {
   public:
    explicit FakeWriter(FakeWire::WriterEnd& end) : end_(end) {}
    ~FakeWriter() override { end_.gone = true; }
    dds::Guid guid() const override { return end_.guid; }
    std::vector<dds::Guid> readers() const override { return end_.readers; }
    std::vector<dds::Guid> certain_readers() const override {
      return end_.found ? end_.readers : std::vector<dds::Guid>();
    }

   private:
    void send(ByteView payload, const dds::SampleId* related) override {
      end_.written.push_back({{payload.begin(), payload.end()}, {}});
      if (related != nullptr) end_.written.back().related = *related;
    }
    FakeWire::WriterEnd& end_;
  };
  class FakeReader : public dds::Reader {
   public:
    explicit FakeReader(FakeWire::ReaderEnd& end) : end_(end) {}
    std::vector<dds::Sample> take() override { return std::exchange(end_.waiting, {}); }
    dds::Guid guid() const override { return end_.guid; }
    std::vector<dds::Guid> writers() const override { return {}; }

   private:
    FakeWire::ReaderEnd& end_;
  };

  FakeWire& wire_;
  std::uint8_t next_ = 2;
};

}  // namespace astro::dds
