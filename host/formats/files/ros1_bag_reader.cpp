#include "host/formats/files/ros1_bag_reader.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <unordered_map>

#include "host/base/byte_source.hpp"
#include "host/base/error.hpp"
#include "host/formats/files/compression.hpp"

namespace astro::bag {
namespace {

constexpr std::string_view kVersion = "2.0";
constexpr std::uint64_t kMebibytes = std::uint64_t{1} << 20;
constexpr std::uint64_t kMostHeadBytes = kMebibytes, kMostConnectionBytes = 4 * kMebibytes;
constexpr std::size_t kMostConnections = 65'536;

enum class Ros1Op : std::uint8_t { message = 2, file_head = 3, chunk = 5, connection = 7 };

/// Calls `take(name, value)` for each field of a head. False if a field reaches past the end or has no '='.
bool for_each_head_field(ByteView head, const std::function<void(std::string_view, ByteView)>& take) {
  ByteCursor cursor(head);
  while (cursor.left() > 0) {
    const ByteView field = cursor.take(cursor.number<std::uint32_t>());
    const std::size_t equals = as_text(field).find('=');
    if (!cursor.ok() || equals == std::string_view::npos) return false;
    take(as_text(field.first(equals)), field.subspan(equals + 1));
  }
  return true;
}

template <Number T>
T head_number(ByteView value) {
  return value.size() == sizeof(T) ? load<T>(value, 0) : T{};
}

struct Ros1Record {
  Ros1Op op{};
  std::uint32_t connection = 0, size = 0;  // size: of an expanded chunk
  std::int64_t time_ns = 0;
  std::uint64_t index_at = 0;
  std::string topic, compression;
  std::uint64_t data_at = 0, data_bytes = 0;

  std::uint64_t end() const { return data_at + data_bytes; }
};

std::optional<Ros1Record> record_of(ByteView head) {
  Ros1Record record;
  const bool whole = for_each_head_field(head, [&](std::string_view name, ByteView value) {
    if (name == "op") record.op = static_cast<Ros1Op>(head_number<std::uint8_t>(value));
    if (name == "conn") record.connection = head_number<std::uint32_t>(value);
    if (name == "size") record.size = head_number<std::uint32_t>(value);
    if (name == "index_pos") record.index_at = head_number<std::uint64_t>(value);
    if (name == "topic") record.topic = as_text(value);
    if (name == "compression") record.compression = as_text(value);
    if (name != "time" || value.size() != 8) return;
    record.time_ns =
        std::int64_t{1'000'000'000} * load<std::uint32_t>(value, 0) + load<std::uint32_t>(value, 4);
  });
  if (!whole || record.op == Ros1Op{}) return std::nullopt;
  return record;
}

class Ros1Reader {
 public:
  Ros1Reader(const Ros1BagFile& file, TopicTable& topics, BagReport& report)
      : file_(file), topics_(topics), report_(report), source_(file.path) {
    messages_ = {24 * kMebibytes + file.stored_bytes, 64 * kMebibytes + 256 * file.stored_bytes};
    most_chunk_bytes_ = std::max(32 * kMebibytes, file.stored_bytes);
    chunk_bytes_left_ = 64 * kMebibytes + 256 * file.stored_bytes;
  }

  void read() {
    const std::uint64_t start = first_record();
    walk(source_, start, source_.size(), nullptr);
    if (!closed_ && !cut_) cut("its recorder did not close it");
    if (closed_ && index_at_ >= source_.size() && !cut_) cut("it ends without its index");
  }

 private:
  void warn(BagDamage kind, const std::string& what, std::vector<std::string> values = {}) {
    values.insert(values.begin(), file_.name);
    if (report_.warnings.size() < 8)
      report_.warnings.push_back({file_.name + ": " + what, kind, std::move(values)});
  }
  void cut(const std::string& what) {
    cut_ = report_.truncated = true;
    warn(BagDamage::cut_off, what);
  }
  void damage(BagDamage kind, const std::string& what, std::uint64_t at) {
    report_.damaged = true;
    warn(kind, what + " at byte " + std::to_string(at), {std::to_string(at)});
  }

  /// Behind the line that says the version.
  std::uint64_t first_record() {
    constexpr std::uint64_t kLongestLine = 32;
    const auto size = static_cast<std::size_t>(std::min(source_.size(), kLongestLine));
    const std::string_view start = as_text(source_.read(0, size));
    const std::size_t end = std::min(start.find('\n'), start.size());
    const std::string version(start.substr(kRos1BagMark.size(), end - kRos1BagMark.size()));
    if (version != kVersion)
      throw Error(file_.name + " is a bag of ROS 1 of the version '" + version +
                      "', and only 2.0 is read: bring it to that version with rosbag fix",
                  BagProblem::old_version, {file_.name, version});
    return end + 1;
  }

  /// Reads the records in a range of the file or of an expanded chunk. `chunk` is the chunk around them, null
  /// for none.
  void walk(ByteSource& source, std::uint64_t at, std::uint64_t end, const Ros1Record* chunk) {
    while (at < end) {
      const auto record = next(source, at, end);
      if (!record) return no_record(at, chunk);
      const bool enters = chunk == nullptr && record->op == Ros1Op::chunk && record->compression == "none";
      if (record->end() > end && !enters) return no_record(at, chunk);
      take(source, *record, end, chunk);
      at = record->end();
    }
    // The chunk that a killed recorder was writing says that it is empty.
    if (at > end && chunk == nullptr) cut("it ends at byte " + std::to_string(end) + " inside a chunk");
  }

  /// Nothing if there is no head of a record.
  static std::optional<Ros1Record> next(ByteSource& source, std::uint64_t at, std::uint64_t end) {
    constexpr std::size_t kLength = sizeof(std::uint32_t);
    if (end - at < kLength) return std::nullopt;
    const auto head_bytes = load<std::uint32_t>(source.read(at, kLength), 0);
    if (head_bytes > kMostHeadBytes || end - at < std::uint64_t{head_bytes} + 2 * kLength)
      return std::nullopt;
    const ByteView head = source.read(at + kLength, head_bytes + kLength);
    auto record = record_of(head.first(head_bytes));
    if (!record) return std::nullopt;
    record->data_bytes = load<std::uint32_t>(head, head_bytes);
    record->data_at = at + 2 * kLength + head_bytes;
    return record;
  }

  /// A file that was not closed may end anywhere. In one that was, a wrong length or head is damage.
  void no_record(std::uint64_t at, const Ros1Record* chunk) {
    const bool in_cut_chunk =
        chunk != nullptr && chunk->compression == "none" && chunk->end() > source_.size();
    if (in_cut_chunk) return;  // said where that chunk ends
    if (chunk == nullptr && (!closed_ || index_at_ >= source_.size() || at >= index_at_))
      return cut("it ends inside a record at byte " + std::to_string(at));
    damage(BagDamage::record_does_not_fit, "a record that does not fit",
           chunk == nullptr ? at : chunk->data_at);
  }

  void take(ByteSource& source, const Ros1Record& record, std::uint64_t end, const Ros1Record* chunk) {
    switch (record.op) {
      case Ros1Op::file_head:
        index_at_ = record.index_at;
        closed_ = index_at_ != 0;
        return;
      case Ros1Op::chunk:
        if (chunk == nullptr) this->chunk(record, end);
        return;
      case Ros1Op::connection:
        return connection(source, record);
      case Ros1Op::message:
        return message(source, record);
      default:
        return;  // indexes
    }
  }

  void chunk(const Ros1Record& record, std::uint64_t end) {
    if (record.compression == "none")
      return walk(source_, record.data_at, std::min(record.end(), end), &record);
    if (record.data_bytes == 0) return;
    if (record.size > most_chunk_bytes_ || record.data_bytes > most_chunk_bytes_)
      return damage(BagDamage::chunk_too_large, "a chunk of more bytes than this reader takes",
                    record.data_at);
    if (record.size > chunk_bytes_left_)
      return damage(BagDamage::chunk_too_large, "chunks that expand to more than 256 times the file",
                    record.data_at);
    chunk_bytes_left_ -= record.size;
    const bool known = record.compression == "bz2" || record.compression == "lz4";
    const auto bytes =
        known ? expand(record.compression,
                       source_.read(record.data_at, static_cast<std::size_t>(record.data_bytes)), record.size)
              : std::nullopt;
    if (!bytes)
      return damage(BagDamage::chunk_does_not_expand, "a chunk that does not expand", record.data_at);
    MemorySource inside(*bytes);
    walk(inside, 0, inside.size(), &record);
  }

  void connection(ByteSource& source, const Ros1Record& record) {
    if (connections_.contains(record.connection)) return;  // repeated in each chunk and in the index
    if (record.data_bytes > kMostConnectionBytes || connections_.size() >= kMostConnections)
      return damage(BagDamage::too_many_topics, "more connections than this reader takes", record.data_at);
    std::string_view topic = record.topic, type, definition;
    const ByteView head = source.read(record.data_at, static_cast<std::size_t>(record.data_bytes));
    const bool whole = for_each_head_field(head, [&](std::string_view name, ByteView value) {
      if (name == "type") type = as_text(value);
      if (name == "message_definition") definition = as_text(value);
    });
    if (!whole || topic.empty()) return damage(BagDamage::bad_connection, "a bad connection", record.data_at);
    TopicTable::Entry* entry = topics_.entry(topic, type, "ros1", {"ros1msg", definition});
    if (entry == nullptr)
      return damage(BagDamage::too_many_topics, "more topics than this reader takes", record.data_at);
    connections_.emplace(record.connection, entry);
  }

  void message(ByteSource& source, const Ros1Record& record) {
    const auto entry = connections_.find(record.connection);
    if (entry == connections_.end())
      return damage(BagDamage::message_of_unknown_topic, "a message of an unknown connection",
                    record.data_at);
    if (record.data_bytes > most_chunk_bytes_)
      return damage(BagDamage::message_too_large, "a message of more bytes than this reader takes",
                    record.data_at);
    const std::optional<MessageFault> fault =
        topics_.take(*entry->second, record.time_ns,
                     source.read(record.data_at, static_cast<std::size_t>(record.data_bytes)), messages_);
    if (fault) damage(fault->kind, fault->what, record.data_at);
  }

  const Ros1BagFile& file_;
  TopicTable& topics_;
  BagReport& report_;
  FileSource source_;
  TopicTable::ExpansionLimit messages_;
  std::uint64_t most_chunk_bytes_ = 0, chunk_bytes_left_ = 0, index_at_ = 0;
  bool closed_ = false, cut_ = false;
  std::unordered_map<std::uint32_t, TopicTable::Entry*> connections_;
};

}  // namespace

void read_ros1_bag(const Ros1BagFile& file, TopicTable& topics, BagReport& report) {
  Ros1Reader(file, topics, report).read();
}

}  // namespace astro::bag
