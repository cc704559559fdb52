#pragma once

#include <map>
#include <optional>
#include <string_view>

#include "host/formats/files/bag.hpp"
#include "host/formats/files/bag_damage.hpp"

namespace astro::bag {

/// A type's definition as a bag has it. Formats: "ros1msg", "ros2msg", and others that are not read.
struct Definition {
  std::string_view format, text;
};

/// What is wrong with a message, for a person and for a program.
struct MessageFault {
  const char* what;
  BagDamage kind;
};

/// Takes the messages from the readers of all storages. It counts the messages of each topic, expands those
/// that were compressed one by one, turns those of ROS 1 into CDR, and passes the wanted ones on.
class TopicTable {
 public:
  struct Entry {
    BagTopic topic;
    bool wanted = false;
    std::string ros1_type;  // the name in the bag; "" for messages that are passed on as they are

    /// Whether a definition in the bag is of this topic.
    bool is(std::string_view name, std::string_view type, std::string_view encoding) const;
  };

  explicit TopicTable(const BagHandlers& handlers) : handlers_(handlers) {}

  /// The entry of that topic, made if needed; its address does not change. Names are as in the bag. Null if
  /// the bag has more topics, or names of more characters in all, than any robot has.
  Entry* entry(std::string_view name, std::string_view type, std::string_view encoding,
               const Definition& definition);

  /// The sizes to which one compressed message, and all messages of a file, may expand.
  struct ExpansionLimit {
    std::uint64_t one_bytes = 0, all_bytes = 0;  // all_bytes becomes less with each message
  };

  /// Returns what is wrong with a message that does not expand or to more than is allowed, or that does not
  /// fit its definition; it is counted nevertheless. Times are brought within 2^62 ns of 1970, which is until
  /// 2116, so that the difference of any two is a number.
  std::optional<MessageFault> take(Entry& entry, std::int64_t log_time_ns, ByteView data,
                                   ExpansionLimit& limit);

  std::vector<BagTopic> topics() const;

 private:
  using Layout = std::shared_ptr<const ros2::MessageLayout>;

  Layout layout(std::string_view type, const Definition& definition);

  const BagHandlers& handlers_;
  std::map<std::string, Entry, std::less<>> entries_;  // by name, type and encoding
  std::vector<const Entry*> order_;
  std::map<std::string, Layout> layouts_;  // by type, and size and checksum of its definition
  std::size_t name_bytes_ = 0, definition_bytes_ = 0;
};

}  // namespace astro::bag
