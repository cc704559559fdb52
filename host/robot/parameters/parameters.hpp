#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/robot/client/client.hpp"
#include "host/robot/parameters/parameter_row.hpp"

namespace astro::robot {

/// The robot's parameter table as the robot itself describes it; works also for parameters that this program
/// does not know.
///
/// Errors  what Client::request throws; a refused value or set is named by its parameter.
class RemoteParameters {
 public:
  /// Many times the present number of parameters. To read so many, at two requests each, takes 1.5 s on a slow link.
  static constexpr std::uint16_t kMostParameters = 512;

  /// Two requests per parameter. The Client must outlive the result. Throws Error if the robot claims more
  /// than kMostParameters. `tries`: how often each request is sent, now and later, before the link counts as lost.
  static RemoteParameters fetch(Client& client, int tries = RetryPolicy().tries);

  /// The same in steps, for callers that must not wait for the whole table: begin() sends no request yet, and each
  /// read_next() reads one parameter, until is_complete() returns true.
  static RemoteParameters begin(Client& client, int tries = RetryPolicy().tries);
  bool is_complete() const;
  void read_next();

  const std::vector<ParameterRow>& rows() const { return rows_; }
  const ParameterRow* find(std::string_view name) const;

  /// Throws Error if the robot has no such parameter.
  const ParameterRow& row(std::string_view name) const;

  /// The value in force, in the row's unit or as text.
  Value value(std::string_view name) const;

  /// The same of a parameter that is a number. Throws Error if the robot has no such parameter, or a text there.
  double number(std::string_view name) const;
  /// The values of all parameters that are numbers.
  std::map<std::string, double> numbers() const;

  /// Stages a value; it is not in force before commit() or apply(). Throws as to_raw does, without asking the
  /// robot. The first call of stage(), commit() or apply() opens the robot's staging area for this session,
  /// filled with the set in force. If another session opens it afterwards, this session loses it:
  /// RobotRefused, staging_lost.
  void stage(std::string_view name, const Value& value);

  /// Puts all values in force that were staged since the area was opened, and writes them to flash; all or
  /// none.
  void commit();
  /// Commits all values in force, also those that were only applied.
  void save();

  /// Puts all staged values in force until the robot restarts, all or none; also while it drives, if only
  /// gains differ.
  void apply();

  /// Open the staging area again: revert() with the set in force, defaults() with the factory defaults.
  void revert();
  void defaults();

  /// Reads all values again: one request per parameter.
  void refresh();
  /// Reads the values of the row with this index again.
  void refresh(std::size_t index) { read_value(rows_.at(index)); }

 private:
  RemoteParameters(Client& client, int tries) : client_(&client), tries_(tries) {}
  template <protocol::Request M>
  typename M::Reply ask(const M& message) const {
    return client_->request(message, {retry_policy_for<M>().timeout, tries_});
  }
  void read_value(ParameterRow& row);
  template <class Request>
  void put_in_force(const Request& request);
  ParameterRow& mutable_row(std::string_view name);

  Client* client_;
  int tries_;
  std::vector<ParameterRow> rows_;
  bool opened_ = false;
};

}  // namespace astro::robot
