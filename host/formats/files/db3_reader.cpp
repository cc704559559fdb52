#include "host/formats/files/db3_reader.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "host/base/byte_source.hpp"
#include "host/base/error.hpp"
#include "host/formats/files/bag_damage.hpp"
#include "host/formats/files/sqlite.hpp"

namespace astro::bag {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRowBytes = std::uint64_t{1} << 20;    // of a row, beyond what the file holds
constexpr std::uint64_t kFreeBytes = std::uint64_t{24} << 20;  // of a message, beyond the size of the file
constexpr int kOperationsPerCall = 10'000;  // of SQLite's virtual machine, until it asks whether to go on

/// Limits what SQLite may do with a file of a given size. Each row takes at least 6 bytes of the file and
/// some 20 operations.
struct Effort {
  std::uint64_t left = 0;
  static int ask(void* effort) {
    auto& left = static_cast<Effort*>(effort)->left;
    if (left < kOperationsPerCall) return 1;
    left -= kOperationsPerCall;
    return 0;
  }
};

/// What the first page says of the file; zeros if there is none.
struct Header {
  std::uint64_t page_bytes = 0, pages = 0;

  explicit Header(const fs::path& path) {
    FileSource file(path);
    constexpr std::size_t kHeaderBytes = 100;
    if (file.size() < kHeaderBytes) return;
    const ByteView header = file.read(0, kHeaderBytes);
    const std::uint64_t page = header[16] * 256U + header[17];
    page_bytes = page == 1 ? 65'536 : page;
    for (std::size_t i = 28; i < 32; ++i) pages = pages << 8U | header[i];
  }
  std::uint64_t file_bytes() const { return page_bytes * pages; }
};

class Db3Reader {
 public:
  Db3Reader(const Db3File& file, TopicTable& topics, BagReport& report)
      : file_(file), topics_(topics), report_(report) {
    std::error_code ignored;
    size_ = fs::file_size(file.path, ignored);
    if (file.with_log) size_ += fs::file_size(fs::path(file.path) += "-wal", ignored) + 1;
    expansion_ = {kFreeBytes + file.stored_bytes, (std::uint64_t{64} << 20) + 256 * file.stored_bytes};
    effort_.left = 10'000'000 + 16 * size_;
    sqlite3* raw = nullptr;
    const int flags = (file.with_log ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY) | SQLITE_OPEN_URI |
                      SQLITE_OPEN_NOMUTEX;
    const std::string uri = sqlite_uri(file.path, file.with_log ? "mode=rw" : "immutable=1");
    const int opened = sqlite3_open_v2(uri.c_str(), &raw, flags, nullptr);
    database_.reset(raw);
    if (opened != SQLITE_OK) refuse("cannot be opened: " + why());
    harden();
    if (!file.with_log) allow_cut();
  }

  void read() {
    require_tables();
    read_definitions();
    read_topics();
    read_messages();
  }

 private:
  using Entry = TopicTable::Entry;

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(file_.name + " " + what + ": name the right file", BagProblem::unreadable_database,
                {file_.name});
  }
  [[noreturn]] void refuse_table(BagProblem problem, const std::string& what,
                                 const std::string& table) const {
    throw Error(file_.name + " " + what + ": name the right file", problem, {file_.name, table});
  }
  std::string why() const { return sqlite3_errmsg(database_.get()); }
  void damage(BagDamage kind, const std::string& what, std::vector<std::string> values = {}) {
    (cut_ ? report_.truncated : report_.damaged) = true;
    warn(kind, what, std::move(values));
  }
  void warn(BagDamage kind, const std::string& what, std::vector<std::string> values = {}) {
    if (report_.warnings.size() >= 8) return;
    values.insert(values.begin(), file_.name);
    report_.warnings.push_back({file_.name + ": " + what, kind, std::move(values)});
  }

  void harden() {
    sqlite3* db = database_.get();
    sqlite3_db_config(db, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    sqlite3_db_config(db, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_db_config(db, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    const std::uint64_t most = std::min<std::uint64_t>(
        {kRowBytes + size_, kFreeBytes + file_.stored_bytes, std::numeric_limits<int>::max()});
    sqlite3_limit(db, SQLITE_LIMIT_LENGTH, static_cast<int>(most));
    sqlite3_progress_handler(db, kOperationsPerCall, &Effort::ask, &effort_);
  }

  /// SQLite refuses a file that is shorter than its header says, unless the schema may be repaired.
  void allow_cut() {
    const std::uint64_t expected = Header(file_.path).file_bytes();
    if (size_ >= expected) return;
    cut_ = report_.truncated = true;
    warn(BagDamage::database_cut_off,
         "the file ends at byte " + std::to_string(size_) + " of " + std::to_string(expected),
         {std::to_string(size_), std::to_string(expected)});
    Statement(database_.get(), "PRAGMA writable_schema=ON").step();
  }

  void require_tables() {
    for (const std::string table : {"topics", "messages"}) {
      Statement found(
          database_.get(),
          "SELECT rootpage > 0 FROM sqlite_master WHERE type = 'table' AND name = '" + table + "'");
      const int step = found.step();
      if (step == SQLITE_NOTADB) refuse("is not a database");
      if (step != SQLITE_ROW && step != SQLITE_DONE) refuse("cannot be read as a bag: " + why());
      if (step == SQLITE_DONE || found.integer(0) == 0)
        refuse_table(BagProblem::no_such_table,
                     "is a database, but not a bag: it has no table '" + table + "'", table);
      Statement computed(database_.get(),
                         "SELECT count(*) FROM pragma_table_xinfo('" + table + "') WHERE hidden <> 0");
      if (computed.step() != SQLITE_ROW || computed.integer(0) != 0)
        refuse_table(BagProblem::computed_columns,
                     "is not a bag: its table '" + table + "' has computed columns", table);
    }
  }

  /// Bags have definitions since version 4 of the schema.
  void read_definitions() {
    constexpr std::size_t kMostBytes = std::size_t{2} << 20;
    Statement found(
        database_.get(),
        "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'message_definitions' AND rootpage "
        "> 0 AND NOT EXISTS (SELECT 1 FROM pragma_table_xinfo('message_definitions') WHERE hidden <> 0)");
    if (found.step() != SQLITE_ROW) return;
    Statement rows(
        database_.get(),
        "SELECT rowid, topic_type, encoding, encoded_message_definition FROM message_definitions NOT "
        "INDEXED ORDER BY rowid");
    std::size_t bytes = 0;
    last_row_.reset();
    while (rows.step() == SQLITE_ROW && rises(rows)) {
      if (as_text(rows.bytes(2)) != "ros2msg") continue;
      bytes += rows.bytes(1).size() + rows.bytes(3).size();
      if (bytes > kMostBytes) return;
      definitions_.emplace(as_text(rows.bytes(1)), as_text(rows.bytes(3)));
    }
  }

  /// Whether rows still come in rising order; a damaged file can have pages that lead round in a circle.
  bool rises(const Statement& row) {
    const bool rising = !last_row_ || row.integer(0) > *last_row_;
    last_row_ = row.integer(0);
    if (!rising) damage(BagDamage::rows_out_of_order, "rows that are out of order");
    return rising;
  }

  void read_topics() {
    Statement rows(
        database_.get(),
        "SELECT rowid, id, name, type, serialization_format FROM topics NOT INDEXED ORDER BY rowid");
    if (rows.prepared() != SQLITE_OK) refuse("is not a bag of any known version: " + why());
    last_row_.reset();
    int step = 0;
    while ((step = rows.step()) == SQLITE_ROW && rises(rows)) {
      const auto defined = definitions_.find(as_text(rows.bytes(3)));
      const Definition definition =
          defined == definitions_.end() ? Definition() : Definition{"ros2msg", defined->second};
      Entry* entry =
          topics_.entry(as_text(rows.bytes(2)), as_text(rows.bytes(3)), as_text(rows.bytes(4)), definition);
      if (entry == nullptr) return damage(BagDamage::too_many_topics, "more topics than this reader takes");
      by_id_.try_emplace(rows.integer(1), entry);
    }
    if (step != SQLITE_ROW && step != SQLITE_DONE)
      damage(BagDamage::unreadable_topics, "topics that cannot be read (" + why() + ")");
  }

  /// The data of topics that nobody wants are not even read from the file.
  std::string query() const {
    std::string ids;
    for (const auto& [id, entry] : by_id_)
      if (entry->wanted) ids += (ids.empty() ? "" : ",") + std::to_string(id);
    return "SELECT rowid, topic_id, timestamp, CASE WHEN topic_id IN (" + ids +
           ") THEN data END FROM messages NOT INDEXED ORDER BY rowid";
  }

  void read_messages() {
    Statement rows(database_.get(), query());
    if (rows.prepared() != SQLITE_OK) refuse("is not a bag of any known version: " + why());
    last_row_.reset();
    int step = 0;
    while ((step = rows.step()) == SQLITE_ROW && rises(rows)) take(rows);
    if (step == SQLITE_ROW || step == SQLITE_DONE) return;
    const std::string last = std::to_string(last_row_.value_or(0));
    damage(BagDamage::unreadable_messages,
           "messages that cannot be read, from row " + last + " on (" + why() + ")", {last});
  }

  void take(const Statement& row) {
    const auto entry = by_id_.find(row.integer(1));
    if (entry == by_id_.end())
      return damage(BagDamage::message_of_unknown_topic, "a message of an unknown topic");
    const bool has_data = row.is_blob(3);
    if (!row.is_integer(2) || has_data != entry->second->wanted)
      return damage(BagDamage::message_incomplete, "a message without time or data");
    const std::optional<MessageFault> fault =
        topics_.take(*entry->second, row.integer(2), row.bytes(3), expansion_);
    if (fault) damage(fault->kind, fault->what);
  }

  const Db3File& file_;
  TopicTable& topics_;
  BagReport& report_;
  Database database_;
  std::uint64_t size_ = 0;
  TopicTable::ExpansionLimit expansion_;
  Effort effort_;
  bool cut_ = false;
  std::optional<std::int64_t> last_row_;
  std::map<std::string, std::string, std::less<>> definitions_;  // by type
  std::unordered_map<std::int64_t, Entry*> by_id_;
};

}  // namespace

std::uint64_t bytes_in_whole_pages(const fs::path& path) {
  const std::uint64_t size = fs::file_size(path);
  const std::uint64_t page = Header(path).page_bytes;
  return page == 0 ? size : size / page * page;
}

void read_db3(const Db3File& file, TopicTable& topics, BagReport& report) {
  Db3Reader(file, topics, report).read();
}

}  // namespace astro::bag
