#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/base/files.hpp"
#include "host/formats/files/bag.hpp"
#include "host/formats/files/compression.hpp"
#include "host/formats/files/mcap_writer.hpp"
#include "host/formats/files/sqlite.hpp"

/// Small bags, made by SQL and by our MCAP writer, and what the reader says of them.
namespace astro::bag::made_bags {

namespace fs = std::filesystem;

inline void save(const fs::path& path, ByteView bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

inline bag::Database open(const fs::path& path) {
  sqlite3* raw = nullptr;
  if (sqlite3_open(path.c_str(), &raw) != SQLITE_OK) throw std::runtime_error("no database");
  return bag::Database(raw);
}

inline void run(const bag::Database& database, const std::string& sql) {
  char* why = nullptr;
  if (sqlite3_exec(database.get(), sql.c_str(), nullptr, nullptr, &why) != SQLITE_OK)
    throw std::runtime_error(sql + ": " + (why == nullptr ? "?" : why));
}

/// The tables as the four versions of the storage plugin make them.
inline std::string schema(int version) {
  std::string sql;
  if (version >= 3)
    sql +=
        "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY,ros_distro TEXT NOT NULL);"
        "CREATE TABLE metadata(id INTEGER PRIMARY KEY,metadata_version INTEGER NOT NULL,metadata TEXT NOT "
        "NULL);"
        "INSERT INTO schema VALUES(" +
        std::to_string(version) + ",'x');";
  if (version >= 4)
    sql +=
        "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY,topic_type TEXT NOT NULL,encoding TEXT NOT "
        "NULL,encoded_message_definition TEXT NOT NULL,type_description_hash TEXT NOT NULL);";
  sql +=
      "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,serialization_format "
      "TEXT "
      "NOT NULL";
  if (version >= 2) sql += ",offered_qos_profiles TEXT NOT NULL DEFAULT ''";
  if (version >= 4) sql += ",type_description_hash TEXT NOT NULL DEFAULT ''";
  return sql +
         ");CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT "
         "NULL, data "
         "BLOB NOT NULL);CREATE INDEX timestamp_idx ON messages (timestamp ASC);"
         "INSERT INTO topics(id,name,type,serialization_format) "
         "VALUES(1,'/a','p/msg/A','cdr'),(2,'/b','p/msg/B','cdr');";
}

inline void add(const bag::Database& database, int topic, std::int64_t time_ns, ByteView data) {
  bag::Statement insert(database.get(), "INSERT INTO messages(topic_id,timestamp,data) VALUES(?,?,?)");
  insert.bind(1, std::int64_t{topic});
  insert.bind(2, time_ns);
  insert.bind(3, data);
  if (insert.step() != SQLITE_DONE) throw std::runtime_error(sqlite3_errmsg(database.get()));
}

/// Message i of a bag, recognisable and without repetition.
inline Bytes message(int i, std::size_t size = 24) {
  Bytes data{0, 1, 0, 0};
  while (data.size() < size)
    append(data, 0x9E3779B97F4A7C15U * static_cast<std::uint64_t>(i + 1) + data.size());
  return data;
}

inline void make_db3(const fs::path& path, int messages, int first = 0, std::size_t size = 24) {
  const bag::Database database = open(path);
  run(database, "PRAGMA journal_mode=OFF;PRAGMA synchronous=OFF;BEGIN;" + schema(4));
  for (int i = first; i < first + messages; ++i) add(database, 1 + i % 2, 1000 + i, message(i, size));
  run(database, "COMMIT");
}

inline Bytes made_mcap(int messages, int first = 0, std::size_t size = 24) {
  Bytes file;
  bag::McapWriter writer([&](ByteView bytes) { append(file, bytes); }, {"ros2", "test"}, {1000, 1'000'000});
  const auto a = writer.add_channel(writer.add_schema("p/msg/A", "ros2msg", ""), "/a", "cdr", {});
  const auto b = writer.add_channel(writer.add_schema("p/msg/B", "ros2msg", ""), "/b", "cdr", {});
  for (int i = first; i < first + messages; ++i)
    writer.write(i % 2 == 0 ? a : b, static_cast<std::uint64_t>(1000 + i), message(i, size));
  writer.close();
  return file;
}

struct Seen {
  bag::BagReport report;
  std::vector<std::string> messages;  // topic, time and the number of the message
};

inline std::string shown(const std::string& topic, std::int64_t time_ns, ByteView data) {
  return topic + " " + std::to_string(time_ns) + " " + std::to_string(bag::crc32_ieee(data));
}

inline Seen read(const fs::path& path) {
  Seen seen;
  bag::BagHandlers handlers;
  handlers.message = [&](const bag::BagTopic& topic, const bag::BagMessage& message) {
    seen.messages.push_back(shown(topic.name, message.log_time_ns, message.data));
  };
  seen.report = bag::read_bag(path, handlers);
  return seen;
}

inline std::vector<std::string> expected(int messages, int first = 0, std::size_t size = 24) {
  std::vector<std::string> all;
  for (int i = first; i < first + messages; ++i)
    all.push_back(shown(i % 2 == 0 ? "/a" : "/b", 1000 + i, message(i, size)));
  return all;
}

}  // namespace astro::bag::made_bags
