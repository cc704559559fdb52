#pragma once

#include <optional>

#include "common/base/serial_number.hpp"
#include "common/params/store.hpp"
#include "common/protocol/parameters.hpp"

namespace astro {

/// The parameter set in force, the staged set, and the flash that keeps parameters. Main loop only.
///
/// The staged set belongs to the port that opened it. No other port can stage into it, commit it or apply it,
/// so two hosts never mix their values.
template <NorFlash Flash, class Mark>
class ParameterService {
 public:
  template <class Reply>
  using Answer = protocol::Answer<Reply>;

  /// `mark` must lie in other sectors than the parameters.
  ParameterService(Flash& flash, Mark mark) : store_(flash), mark_(mark) {}

  /// Reads the flash. False if it holds a set that this firmware refuses, or if a committed set is lost: then
  /// the defaults or an older set are in force.
  [[gnu::cold]] bool load() {
    const Load loaded = store_.load();
    active_ = staged_ = loaded.set;
    fell_back_ = loaded.outrun;
    const std::optional<std::uint32_t> reached = mark_.newest();
    const bool lost =
        reached && (loaded.status == LoadStatus::no_record || is_newer(*reached, loaded.sequence));
    if (!lost) follow(loaded, reached);
    return loaded.status != LoadStatus::refused && !lost;
  }

  const ParameterSet& active() const { return active_; }
  /// The start found a newer set damaged: bits rotted, or the power failed during its commit.
  bool fell_back() const { return fell_back_; }

  [[gnu::cold]] Answer<protocol::ParameterInfo> info(std::uint16_t index) const {
    if (index >= kParamCount) return error(protocol::ErrorCode::unknown_parameter);
    const ParamRow& row = kParamTable[index];
    return protocol::ParameterInfo{.id = static_cast<std::uint16_t>(row.id),
                                   .name = Text<24>(row.name),
                                   .unit = Text<8>(row.unit),
                                   .kind = on_the_wire(row.kind),
                                   .scale_exponent = row.exponent,
                                   .minimum = row.minimum_raw,
                                   .maximum = row.maximum_raw,
                                   .default_value = row.default_raw,
                                   .doc = Text<120>(row.doc)};
  }

  /// As staged value, `port` gets its own; if it has not opened the staged set, the one in force.
  [[gnu::cold]] Answer<protocol::ParameterValue> value(int port, std::uint16_t id) const {
    const ParameterSet& staged = port == owner_ ? staged_ : active_;
    const ParamRow* row = find_param(id);
    if (row == nullptr) return error(protocol::ErrorCode::unknown_parameter);
    protocol::ParameterValue value{.id = id};
    if (row->kind == ParamKind::text) {
      value.active_text = active_.text(row->id);
      value.staged_text = staged.text(row->id);
    } else {
      value.active = active_.get(row->id);
      value.staged = staged.get(row->id);
    }
    return value;
  }

  /// Does not validate the value: the set is validated as a whole when it is committed.
  [[gnu::cold]] Answer<protocol::Ack> stage(int port, const protocol::StageParameter& request) {
    const ParamRow* row = find_param(request.id);
    if (row == nullptr) return error(protocol::ErrorCode::unknown_parameter);
    if (port != owner_) return error(protocol::ErrorCode::staging_lost);
    changed_ |= std::uint64_t{1} << (row - kParamTable.data());
    if (row->kind == ParamKind::text) {
      staged_.set_text(row->id, request.text);
    } else {
      staged_.set(row->id, request.value);
    }
    return protocol::Ack{};
  }

  /// Begins a staged set with the values in force, or with the defaults. It belongs to this port from now on,
  /// whoever had one before.
  [[gnu::cold]] void open(int port) {
    staged_ = active_;
    owner_ = port;
    changed_ = 0;
  }
  [[gnu::cold]] void open_defaults(int port) {
    staged_ = ParameterSet::defaults();
    owner_ = port;
    changed_ = ~std::uint64_t{0};
  }
  /// A new session has begun at this port: it has staged nothing.
  void close(int port) {
    if (port == owner_) owner_ = kNobody;
  }

  /// Puts the staged set in force until the next restart. While `driving`, only gains may differ.
  [[gnu::cold]] Answer<protocol::Ack> apply(int port, bool driving) {
    if (const Answer<protocol::Ack> refused = check(port); !refused) return refused;
    if (driving && !only_gains_differ(active_, staged_)) return error(protocol::ErrorCode::moving);
    active_ = staged_;
    changed_ = 0;  // these values were only tried: they are no part of the next commit
    return protocol::Ack{};
  }

  /// Writes to flash first, then puts the set in force. Only what this session has staged goes to flash;
  /// values that somebody has only tried (ApplyParameters) stay in force until the next restart.
  [[gnu::cold]] Answer<protocol::Ack> commit(int port) {
    if (const Answer<protocol::Ack> refused = check(port); !refused) return refused;
    const std::optional<std::uint32_t> reached = mark_.newest();
    const ParameterSet kept = changed_in(store_.load().set);
    if (const auto verdict = validate(kept); !verdict)
      return error(protocol::ErrorCode::invalid_parameter, static_cast<std::uint16_t>(verdict.error()));
    if (!store_.commit(kept, reached)) return error(protocol::ErrorCode::flash_failed);
    active_ = staged_;
    changed_ = 0;
    follow(store_.load(), reached);
    return protocol::Ack{};
  }

 private:
  static protocol::ErrorReply error(protocol::ErrorCode code, std::uint16_t detail = 0) {
    return {code, detail};
  }

  static constexpr int kNobody = -1;

  static constexpr protocol::ParameterKind on_the_wire(ParamKind kind) {
    using protocol::ParameterKind;
    const auto same = [](ParamKind a, ParameterKind b) { return static_cast<int>(a) == static_cast<int>(b); };
    static_assert(same(ParamKind::binary_scaled, ParameterKind::binary_scaled) &&
                  same(ParamKind::decimal_scaled, ParameterKind::decimal_scaled) &&
                  same(ParamKind::integer, ParameterKind::integer) &&
                  same(ParamKind::text, ParameterKind::text));
    return static_cast<ParameterKind>(kind);
  }

  /// Brings the mark up to the sequence number that was read back from flash. The mark is never ahead of the
  /// records, so a power cut in between raises no false alarm; the next start brings it up. It need not
  /// follow every commit: sectors are lost as a whole, so it is enough if the mark is newer than every record
  /// outside the newest record's sector.
  void follow(const Load& loaded, std::optional<std::uint32_t> reached) {
    if (loaded.status == LoadStatus::no_record) return;
    const bool up_to_date = reached && (!loaded.two_sectors || is_newer(*reached, loaded.outside));
    if (!up_to_date) mark_.raise(loaded.sequence);
  }

  /// `set` with the values that were staged since open().
  ParameterSet changed_in(ParameterSet set) const {
    for (std::size_t i = 0; i < kParamCount; ++i) {
      if ((changed_ >> i & 1U) == 0) continue;
      const ParamRow& row = kParamTable[i];
      if (row.kind == ParamKind::text) {
        set.set_text(row.id, staged_.text(row.id));
      } else {
        set.set(row.id, staged_.get(row.id));
      }
    }
    return set;
  }

  /// Whether this port may put the staged set in force, and the set is valid.
  Answer<protocol::Ack> check(int port) const {
    if (port != owner_) return error(protocol::ErrorCode::staging_lost);
    const auto verdict = validate(staged_);
    if (!verdict)
      return error(protocol::ErrorCode::invalid_parameter, static_cast<std::uint16_t>(verdict.error()));
    return protocol::Ack{};
  }

  ParameterSet active_, staged_;
  std::uint64_t changed_ = 0;  // bit n: row n was staged since staged_ was opened
  static_assert(kParamCount <= 64);
  int owner_ = kNobody;  // the port whose session has opened staged_
  bool fell_back_ = false;
  Store<Flash> store_;
  Mark mark_;
};

}  // namespace astro
