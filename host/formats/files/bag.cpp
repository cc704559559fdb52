#include "host/formats/files/bag.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include "host/base/byte_source.hpp"
#include "host/base/error.hpp"
#include "host/formats/files/bag_damage.hpp"
#include "host/formats/files/bag_files.hpp"
#include "host/formats/files/compression.hpp"
#include "host/formats/files/db3_reader.hpp"
#include "host/formats/files/mcap_reader.hpp"
#include "host/formats/files/ros1_bag_reader.hpp"
#include "host/formats/files/topic_table.hpp"

namespace astro::bag {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;
constexpr std::size_t kMostWarnings = 8;

/// A folder below TMPDIR that goes with the object, for what must be unpacked or copied before it can be read. Throws
/// astro::Error if it cannot be made.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  fs::path operator/(const fs::path& name) const { return path_ / name; }

 private:
  fs::path path_;
};

ScratchFolder::ScratchFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string pattern = (parent / "bag-XXXXXX").string();
  if (error || ::mkdtemp(pattern.data()) == nullptr) {
    if (!error) error = {errno, std::generic_category()};
    throw Error("cannot make a temporary folder in " + parent.string() + ": " + error.message() +
                ": check its permissions and the disk");
  }
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

/// The topics of the channels of an MCAP file. A channel may be defined again, and then as another topic.
class ChannelTopics {
 public:
  explicit ChannelTopics(TopicTable& topics) : topics_(topics) {}

  /// Null if TopicTable::entry() returns null.
  TopicTable::Entry* entry(const bag::mcap::Channel& channel, const bag::mcap::Schema* schema) {
    const std::string_view type = schema == nullptr ? std::string_view() : std::string_view(schema->name);
    if (entries_.size() <= channel.id) entries_.resize(std::size_t{channel.id} + 1);
    TopicTable::Entry*& entry = entries_[channel.id];
    if (entry == nullptr || !entry->is(channel.topic, type, channel.message_encoding))
      entry = topics_.entry(channel.topic, type, channel.message_encoding,
                            schema == nullptr ? Definition() : Definition{schema->encoding, schema->text});
    return entry;
  }

 private:
  TopicTable& topics_;
  std::vector<TopicTable::Entry*> entries_;  // by the channels' ids
};

class BagReader {
 public:
  explicit BagReader(const BagHandlers& handlers) : topics_(handlers) {}

  BagReport read(const fs::path& path) {
    const BagFiles files = bag_files(path);
    report_.truncated = !files.warnings.empty();
    for (const Remark& warning : files.warnings) warn(warning);
    for (const fs::path& file : files.files) {
      report_.files.push_back(file);
      std::error_code ignored;
      read_file({file, file.string(), fs::file_size(file, ignored)});
    }
    report_.topics = topics_.topics();
    return std::move(report_);
  }

 private:
  void warn(Remark what) {
    if (report_.warnings.size() < kMostWarnings) report_.warnings.push_back(std::move(what));
  }

  /// A file of the bag, or what was unpacked from it.
  struct Part {
    fs::path file;
    std::string name;                // of the bag's own file
    std::uint64_t stored_bytes = 0;  // of the bag's own file, to which all limits refer
    bool is_unpacked = false;
  };

  void warn(const Part& part, const std::string& what, BagDamage kind) {
    warn({part.name + what, kind, {part.name}});
  }

  void read_file(const Part& part) {
    switch (bag_file_kind(part.file)) {
      case BagFileKind::database:
        return read_database(part);
      case BagFileKind::mcap:
        return read_mcap_file(part);
      case BagFileKind::ros1:
        return read_ros1_bag({part.file, part.name, part.stored_bytes}, topics_, report_);
      case BagFileKind::zstd:
        if (!part.is_unpacked) return read_packed(part);
        break;
      case BagFileKind::none:
        break;
    }
    refuse_as_bag(part.name);
  }

  void read_database(const Part& part) {
    const fs::path& file = part.file;
    std::error_code ignored;
    const fs::path logs[] = {fs::path(file) += "-wal", fs::path(file) += "-journal"};
    const bool killed = std::ranges::any_of(logs, [&](const fs::path& log) {
      return fs::is_regular_file(log, ignored) && fs::file_size(log, ignored) > 0;
    });
    const std::uint64_t whole_pages = bytes_in_whole_pages(file);
    const bool partial_page = whole_pages < fs::file_size(file, ignored);
    if (!killed && !partial_page) return read_db3({file, part.name, part.stored_bytes}, topics_, report_);
    const ScratchFolder scratch;
    const fs::path copy = scratch / "copy.db3";
    copy_file(file, copy);
    if (!killed) {
      // SQLite would fill the last page of a cut file with zeros, which would also be in messages.
      fs::resize_file(copy, whole_pages);
      return read_db3({copy, part.name, part.stored_bytes}, topics_, report_);
    }
    for (const fs::path& log : logs)
      if (fs::is_regular_file(log, ignored))
        copy_file(log, copy.string() + log.string().substr(file.string().size()));
    forget_super_journal(copy.string() + "-journal");
    read_db3({copy, part.name, part.stored_bytes, true}, topics_, report_);
  }

  /// The journal of a transaction over several databases ends with the name of a file, which SQLite deletes after the
  /// transaction was rolled back. In a journal from outside that can be any file, so the mark at its end is cut off.
  static void forget_super_journal(const fs::path& journal) {
    constexpr std::uint8_t kMark[] = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};
    std::error_code ignored;
    if (!fs::is_regular_file(journal, ignored)) return;
    FileSource source(journal);
    const std::uint64_t size = source.size();
    if (size >= std::size(kMark) &&
        std::ranges::equal(source.read(size - std::size(kMark), std::size(kMark)), kMark))
      fs::resize_file(journal, size - 1);
  }

  static void copy_file(const fs::path& from, const fs::path& to) {
    std::error_code error;
    if (!fs::copy_file(from, to, error))
      throw Error("cannot copy " + from.string() + " to " + to.string() + ": " + error.message() +
                  ": check its permissions and the disk");
  }

  void read_mcap_file(const Part& part) {
    FileSource source(part.file);
    TopicTable::ExpansionLimit limit{24 * kMebibyte + part.stored_bytes,
                                     64 * kMebibyte + 256 * part.stored_bytes};
    McapLimits limits;
    limits.packed_bytes = part.stored_bytes;
    ChannelTopics channels(topics_);
    bool known = true;
    std::optional<MessageFault> fault;  // of the first message that has one
    McapHandlers handlers;
    handlers.message = [&](const bag::mcap::Channel& channel, const bag::mcap::Schema* schema,
                           const bag::mcap::Message& message) {
      TopicTable::Entry* entry = channels.entry(channel, schema);
      known = known && entry != nullptr;
      if (entry == nullptr) return;
      const auto time_ns = static_cast<std::int64_t>(
          std::min<std::uint64_t>(message.log_time_ns, std::numeric_limits<std::int64_t>::max()));
      const std::optional<MessageFault> wrong = topics_.take(*entry, time_ns, message.data, limit);
      if (!fault) fault = wrong;
    };
    const McapReport report = read_mcap(source, handlers, limits);
    report_.truncated = report_.truncated || report.truncated;
    report_.damaged = report_.damaged || report.damaged || fault || !known;
    for (const Remark& warning : report.warnings) {
      Remark of_part = warning.in(part.name + ": ");
      of_part.values.insert(of_part.values.begin(), part.name);
      warn(std::move(of_part));
    }
    if (!known) warn(part, ": more topics than this reader takes", BagDamage::too_many_topics);
    if (fault) warn(part, std::string(": ") + fault->what, fault->kind);
  }

  void read_packed(const Part& part) {
    const ScratchFolder scratch;
    const fs::path unpacked = scratch / "unpacked";
    FileSource source(part.file);
    std::ofstream out(unpacked, std::ios::binary);
    const Expansion expansion =
        expand_zstd_file(source, 64 * kMebibyte + 256 * source.size(), [&](ByteView piece) {
          if (!out.write(reinterpret_cast<const char*>(piece.data()),
                         static_cast<std::streamsize>(piece.size())))
            throw Error("cannot write " + unpacked.string() + ": check its permissions and the disk");
        });
    out.close();
    if (expansion != Expansion::whole)
      (expansion == Expansion::cut ? report_.truncated : report_.damaged) = true;
    if (expansion == Expansion::cut)
      warn(part, " ends inside its compressed data", BagDamage::packed_cut_off);
    if (expansion == Expansion::too_large)
      warn(part, " expands to more than 256 times its size", BagDamage::packed_too_large);
    if (expansion == Expansion::damaged)
      warn(part, " has damaged compressed data", BagDamage::packed_damaged);
    read_file({unpacked, part.name, part.stored_bytes, true});
  }

  TopicTable topics_;
  BagReport report_;
};

}  // namespace

bool is_bag(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return bag_file_kind(path) != BagFileKind::none;
  try {
    return std::ranges::any_of(bag_files(path).files,
                               [](const fs::path& file) { return bag_file_kind(file) != BagFileKind::none; });
  } catch (const Error&) {
    return false;
  }
}

BagReport read_bag(const fs::path& path, const BagHandlers& handlers) {
  return BagReader(handlers).read(path);
}

}  // namespace astro::bag
