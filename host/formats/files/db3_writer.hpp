#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "host/base/bytes.hpp"
#include "host/formats/files/bag.hpp"

namespace astro::bag {

/// Writes a bag that `ros2 bag` of any version plays: a folder with one SQLite database (schema 4) and a metadata.yaml.
/// The database is a `.part` until close(), so that a bag that is not complete is not mistaken for one.
///
/// Errors  astro::Error naming the file: the folder exists and is not empty, or something cannot be written.
class Db3Writer {
 public:
  explicit Db3Writer(const std::filesystem::path& folder);
  ~Db3Writer();
  Db3Writer(const Db3Writer&) = delete;
  Db3Writer& operator=(const Db3Writer&) = delete;

  /// How late subscribers are served when the bag is played: with what comes, or with the last message as well.
  enum class Durability { volatile_, latched };

  /// Returns the topic's id. `definition` is the ros2msg text of the type.
  int add_topic(std::string_view name, std::string_view type, std::string_view definition,
                Durability durability = Durability::volatile_);
  void write(int topic, std::int64_t time_ns, ByteView data);
  /// Nothing may be written afterwards.
  void close();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace astro::bag
