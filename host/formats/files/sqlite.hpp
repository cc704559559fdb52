#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "host/base/bytes.hpp"

/// SQLite's C interface with owners.
namespace astro::bag {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;

/// A prepared query or command. After step() returned SQLITE_ROW, the columns have values until the next step.
class Statement {
 public:
  Statement(sqlite3* database, const std::string& sql) {
    sqlite3_stmt* raw = nullptr;
    prepared_ = sqlite3_prepare_v2(database, sql.c_str(), -1, &raw, nullptr);
    statement_.reset(raw);
  }

  int prepared() const { return prepared_; }  // SQLITE_OK or why not
  int step() { return statement_ ? sqlite3_step(statement_.get()) : prepared_; }
  void reset() { sqlite3_reset(statement_.get()); }

  bool is_integer(int column) const {
    return sqlite3_column_type(statement_.get(), column) == SQLITE_INTEGER;
  }
  bool is_blob(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_BLOB; }
  bool is_null(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }
  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
  ByteView bytes(int column) const {
    const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
    return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
  }
  std::string text(int column) const { return std::string(as_text(bytes(column))); }

  void bind(int at, std::int64_t value) { sqlite3_bind_int64(statement_.get(), at, value); }
  void bind(int at, std::string_view value) {
    sqlite3_bind_text64(statement_.get(), at, value.data(), value.size(), SQLITE_STATIC, SQLITE_UTF8);
  }
  void bind(int at, ByteView value) {
    sqlite3_bind_blob64(statement_.get(), at, value.data(), value.size(), SQLITE_STATIC);
  }

 private:
  std::unique_ptr<sqlite3_stmt, FinalizeStatement> statement_;
  int prepared_ = SQLITE_OK;
};

/// A file name as SQLite's URIs have it: everything but letters, digits and a few marks is escaped.
std::string sqlite_uri(const std::filesystem::path& path, std::string_view options);

}  // namespace astro::bag
