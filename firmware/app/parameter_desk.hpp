#pragma once

#include <optional>

#include "common/params/store.hpp"
#include "common/protocol/parameters.hpp"

namespace astro {

/// The parameter set in force, the one being prepared, and the flash that keeps it. Main loop only.
///
/// The set being prepared belongs to the port that opened it. Nobody else stages into it, commits or applies
/// it, so two hosts never mix their values.
template <NorFlash Flash, class Mark>
class ParameterDesk {
 public:
  template <class Reply>
  using Answer = Result<Reply, protocol::ErrorReply>;

  /// `mark` lies in other sectors than the parameters.
  ParameterDesk(Flash& flash, Mark mark) : store_(flash), mark_(mark) {}

  /// Reads the flash. False if it holds a set that this firmware refuses, or lacks one that was committed:
  /// the defaults or an older set are then in force.
  [[gnu::cold]] bool load() {
    const Load loaded = store_.load();
    active_ = staged_ = loaded.set;
    fell_back_ = loaded.outrun;
    const std::optional<std::uint32_t> reached = mark_.newest();
    const bool lost = reached && (loaded.status == LoadStatus::no_record ||
                                  static_cast<std::int32_t>(*reached - loaded.sequence) > 0);
    if (!lost) follow(loaded, reached);
    return loaded.status != LoadStatus::refused && !lost;
  }

  const ParameterSet& active() const { return active_; }
  /// The start found a newer set damaged: by rot, or its commit was cut short.
  bool fell_back() const { return fell_back_; }

  Answer<protocol::ParameterInfo> info(std::uint16_t index) const {
    if (index >= kParamCount) return error(protocol::ErrorCode::unknown_parameter);
    const ParamRow& row = kParamTable[index];
    return protocol::ParameterInfo{.id = static_cast<std::uint16_t>(row.id),
                                   .name = Text<24>(row.name),
                                   .unit = Text<8>(row.unit),
                                   .kind = static_cast<protocol::ParameterKind>(row.kind),
                                   .scale_exponent = row.exponent,
                                   .minimum = row.minimum_raw,
                                   .maximum = row.maximum_raw,
                                   .default_value = row.default_raw,
                                   .doc = Text<120>(row.doc)};
  }

  /// `port` sees its own staged value, or the one in force.
  Answer<protocol::ParameterValue> value(int port, std::uint16_t id) const {
    const ParameterSet& staged = port == owner_ ? staged_ : active_;
    const ParamRow* row = find(id);
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

  /// Staging judges nothing: the set is judged as a whole when it is committed.
  Answer<protocol::Ack> stage(int port, const protocol::StageParameter& request) {
    const ParamRow* row = find(request.id);
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

  /// The staged set is that in force, or that of the defaults, and belongs to this port, whoever had one before.
  void open(int port) {
    staged_ = active_;
    owner_ = port;
    changed_ = 0;
  }
  void open_defaults(int port) {
    staged_ = ParameterSet::defaults();
    owner_ = port;
    changed_ = ~std::uint64_t{0};
  }
  /// A new session at this port has staged nothing.
  void close(int port) {
    if (port == owner_) owner_ = kNobody;
  }

  /// In force now, forgotten by a restart. While `driving`, only gains may change.
  Answer<protocol::Ack> apply(int port, bool driving) {
    if (const Answer<protocol::Ack> refused = judge(port); !refused) return refused;
    if (driving && !only_gains_differ(active_, staged_)) return error(protocol::ErrorCode::moving);
    active_ = staged_;
    changed_ = 0;  // only tried, and no part of the next commit
    return protocol::Ack{};
  }

  /// Flash first, then memory. Into the flash comes only what this session has staged; what somebody has only
  /// tried (ApplyParameters) stays in force beside it and goes with the next restart.
  [[gnu::cold]] Answer<protocol::Ack> commit(int port) {
    if (const Answer<protocol::Ack> refused = judge(port); !refused) return refused;
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

  /// Brings the mark up to what lies in flash, and proved so: never ahead of it, so that a power cut in
  /// between raises no alarm. A cut before it is made up for at the next start. It need not follow every
  /// commit, only be ahead of every record outside the newest one's sector, since sectors are lost as a
  /// whole.
  void follow(const Load& loaded, std::optional<std::uint32_t> reached) {
    if (loaded.status == LoadStatus::no_record) return;
    const bool told =
        reached && (!loaded.two_sectors || static_cast<std::int32_t>(*reached - loaded.outside) > 0);
    if (!told) mark_.raise(loaded.sequence);
  }

  /// `set` with what has been staged since the area was opened.
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

  /// Whether this port may put the staged set in force.
  Answer<protocol::Ack> judge(int port) const {
    if (port != owner_) return error(protocol::ErrorCode::staging_lost);
    const auto verdict = validate(staged_);
    if (!verdict)
      return error(protocol::ErrorCode::invalid_parameter, static_cast<std::uint16_t>(verdict.error()));
    return protocol::Ack{};
  }

  static const ParamRow* find(std::uint16_t id) {
    for (const ParamRow& row : kParamTable)
      if (static_cast<std::uint16_t>(row.id) == id) return &row;
    return nullptr;
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
