#pragma once

#include <map>
#include <string_view>

#include "host/formats/files/bag.hpp"

namespace astro::bag {

/// Takes the messages from the readers of both storages. It counts the messages of each topic, expands those that were
/// compressed one by one, and passes the wanted ones on.
class TopicTable {
 public:
  struct Entry {
    BagTopic topic;
    bool wanted = false;
  };

  explicit TopicTable(const BagHandlers& handlers) : handlers_(handlers) {}

  /// The entry of that topic, made if needed; its address does not change. Null if the bag has more topics, or names of
  /// more characters in all, than any robot has.
  Entry* entry(std::string_view name, std::string_view type, std::string_view encoding);

  /// The sizes to which one compressed message, and all messages of a file, may expand.
  struct ExpansionLimit {
    std::uint64_t one_bytes = 0, all_bytes = 0;  // all_bytes becomes less with each message
  };

  /// False if a compressed message does not expand, or to more than is allowed; it is counted nevertheless. Times are
  /// brought within 2^62 ns of 1970, which is until 2116, so that the difference of any two is a number.
  bool take(Entry& entry, std::int64_t log_time_ns, ByteView data, ExpansionLimit& limit);

  std::vector<BagTopic> topics() const;

 private:
  const BagHandlers& handlers_;
  std::map<std::string, Entry, std::less<>> entries_;  // by name, type and encoding
  std::vector<const Entry*> order_;
  std::size_t name_bytes_ = 0;
};

}  // namespace astro::bag
