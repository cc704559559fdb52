#include "host/formats/files/db3_writer.hpp"

#include <algorithm>

#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/formats/files/sqlite.hpp"

namespace astro::bag {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTables =
    "PRAGMA journal_mode=OFF;PRAGMA synchronous=OFF;BEGIN;"
    "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY,ros_distro TEXT NOT NULL);"
    "CREATE TABLE metadata(id INTEGER PRIMARY KEY,metadata_version INTEGER NOT NULL,metadata TEXT NOT NULL);"
    "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,serialization_format "
    "TEXT NOT "
    "NULL,offered_qos_profiles TEXT NOT NULL,type_description_hash TEXT NOT NULL);"
    "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY,topic_type TEXT NOT NULL,encoding TEXT NOT "
    "NULL,encoded_message_definition TEXT NOT NULL,type_description_hash TEXT NOT NULL);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL, data "
    "BLOB NOT "
    "NULL);"
    "INSERT INTO schema VALUES(4,'unknown');";

/// The last version of metadata.yaml that every rosbag2 since Humble reads.
constexpr int kMetadataVersion = 5;

/// Reliable, and the last message for late subscribers; deadline, lifespan and lease without an end.
constexpr std::string_view kLatched =
    "- history: 1\\n  depth: 1\\n  reliability: 1\\n  durability: 1\\n  deadline:\\n    sec: 9223372036\\n   "
    " nsec: "
    "854775807\\n  lifespan:\\n    sec: 9223372036\\n    nsec: 854775807\\n  liveliness: 1\\n  "
    "liveliness_lease_duration:\\n    sec: 9223372036\\n    nsec: 854775807\\n  "
    "avoid_ros_namespace_conventions: false";

std::string with_line_ends(std::string_view escaped) {
  std::string text(escaped);
  for (std::size_t at = 0; (at = text.find("\\n", at)) != std::string::npos;) text.replace(at, 2, "\n");
  return text;
}

/// Text between double quotes as YAML has it.
std::string yaml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace

class Db3Writer::Impl {
 public:
  explicit Impl(const fs::path& folder) : folder_(folder.lexically_normal()) {
    if (!folder_.has_filename()) folder_ = folder_.parent_path();
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) throw Error("cannot make the folder " + folder_.string() + ": " + error.message());
    if (!fs::is_empty(folder_, error))
      throw Error(folder_.string() + " is not empty, and a bag is a folder of its own: choose another folder",
                  BagProblem::folder_not_empty, {folder_.string()});
    file_ = folder_ / (folder_.filename().string() + "_0.db3");
    part_ = file_.string() + ".part";
    sqlite3* raw = nullptr;
    const int opened =
        sqlite3_open_v2(part_.c_str(), &raw, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
    database_.reset(raw);
    if (opened != SQLITE_OK) fail();
    run(kTables);
    insert_ = std::make_unique<Statement>(raw, "INSERT INTO messages(topic_id,timestamp,data) VALUES(?,?,?)");
  }

  int add_topic(std::string_view name, std::string_view type, std::string_view definition,
                Durability durability) {
    const bool latched = durability == Durability::latched;
    Statement topic(database_.get(), "INSERT INTO topics VALUES(?,?,?,'cdr',?,'')");
    topics_.push_back({std::string(name), std::string(type), "cdr", 0, 0, 0});
    latched_.push_back(latched);
    const auto id = static_cast<std::int64_t>(topics_.size());
    const std::string qos = latched ? with_line_ends(kLatched) : "";
    topic.bind(1, id);
    topic.bind(2, name);
    topic.bind(3, type);
    topic.bind(4, std::string_view(qos));
    if (topic.step() != SQLITE_DONE) fail();
    Statement text(database_.get(),
                   "INSERT INTO message_definitions(topic_type,encoding,encoded_message_definition,"
                   "type_description_hash) VALUES(?,'ros2msg',?,'')");
    text.bind(1, type);
    text.bind(2, definition);
    if (text.step() != SQLITE_DONE) fail();
    return static_cast<int>(id);
  }

  void write(int topic, std::int64_t time_ns, ByteView data) {
    BagTopic& at = topics_.at(static_cast<std::size_t>(topic - 1));
    at.first_ns = at.messages == 0 ? time_ns : std::min(at.first_ns, time_ns);
    at.last_ns = at.messages == 0 ? time_ns : std::max(at.last_ns, time_ns);
    ++at.messages;
    insert_->reset();
    insert_->bind(1, std::int64_t{topic});
    insert_->bind(2, time_ns);
    insert_->bind(3, data);
    if (insert_->step() != SQLITE_DONE) fail();
  }

  void close() {
    insert_.reset();
    const std::string text = metadata();
    Statement row(database_.get(), "INSERT INTO metadata(metadata_version,metadata) VALUES(5,?)");
    row.bind(1, std::string_view(text));
    if (row.step() != SQLITE_DONE) fail();
    // The index is made after the rows, which takes half the time of one that grows with them.
    run("CREATE INDEX timestamp_idx ON messages (timestamp ASC);COMMIT");
    row.reset();
    std::error_code error;
    fs::rename(part_, file_, error);
    if (error)
      throw Error("cannot rename " + part_.string() + " to " + file_.string() + ": " + error.message());
    PartFile yaml(folder_ / "metadata.yaml");
    yaml.write(as_bytes(text));
    yaml.commit();
  }

 private:
  [[noreturn]] void fail() const {
    throw Error("cannot write " + part_.string() + ": " + sqlite3_errmsg(database_.get()) +
                "; check the disk or choose another folder");
  }
  void run(const char* sql) {
    if (sqlite3_exec(database_.get(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail();
  }

  std::string metadata() const {
    std::int64_t first_ns = 0, last_ns = 0;
    std::uint64_t messages = 0;
    for (const BagTopic& topic : topics_) {
      if (topic.messages == 0) continue;
      first_ns = messages == 0 ? topic.first_ns : std::min(first_ns, topic.first_ns);
      last_ns = messages == 0 ? topic.last_ns : std::max(last_ns, topic.last_ns);
      messages += topic.messages;
    }
    // Stamps may lie at both ends of their range: their difference then fits an unsigned number only.
    const std::uint64_t duration_ns =
        static_cast<std::uint64_t>(last_ns) - static_cast<std::uint64_t>(first_ns);
    const std::string name = yaml_text(file_.filename().string());
    const auto times = [&](const std::string& indent) {
      return indent + "duration:\n" + indent + "  nanoseconds: " + std::to_string(duration_ns) + "\n" +
             indent + "starting_time:\n" + indent + "  nanoseconds_since_epoch: " + std::to_string(first_ns) +
             "\n" + indent + "message_count: " + std::to_string(messages) + "\n";
    };
    std::string text = "rosbag2_bagfile_information:\n  version: " + std::to_string(kMetadataVersion) +
                       "\n  storage_identifier: sqlite3\n" + times("  ") + "  topics_with_message_count:\n";
    for (std::size_t i = 0; i < topics_.size(); ++i)
      text += "    - topic_metadata:\n        name: " + yaml_text(topics_[i].name) +
              "\n        type: " + topics_[i].type +
              "\n        serialization_format: cdr\n        offered_qos_profiles: \"" +
              (latched_[i] ? std::string(kLatched) : "") +
              "\"\n      message_count: " + std::to_string(topics_[i].messages) + "\n";
    return text + "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - " +
           name + "\n  files:\n    - path: " + name + "\n" + times("      ");
  }

  fs::path folder_, file_, part_;
  Database database_;
  std::unique_ptr<Statement> insert_;  // before the database in destruction
  std::vector<BagTopic> topics_;
  std::vector<bool> latched_;
};

Db3Writer::Db3Writer(const fs::path& folder) : impl_(std::make_unique<Impl>(folder)) {}
Db3Writer::~Db3Writer() = default;

int Db3Writer::add_topic(std::string_view name, std::string_view type, std::string_view definition,
                         Durability durability) {
  return impl_->add_topic(name, type, definition, durability);
}
void Db3Writer::write(int topic, std::int64_t time_ns, ByteView data) { impl_->write(topic, time_ns, data); }
void Db3Writer::close() { impl_->close(); }

}  // namespace astro::bag
