#include "host/robot/parameters/upload.hpp"

#include <type_traits>

#include "host/robot/parameters/parameter_problem.hpp"

namespace astro::robot {

namespace {

class Upload {
 public:
  Upload(Client& client, const std::map<std::string, Value>& values, microseconds reconnect_timeout)
      : client_(client), values_(values), reconnect_timeout_(reconnect_timeout) {}

  UploadReport run() {
    RemoteParameters parameters = through_drops([&] { return RemoteParameters::fetch(client_); });
    const std::vector<ParameterRow> before = parameters.rows();
    for (const auto& [name, value] : values_) to_raw(parameters.row(name), value);
    change(parameters);
    through_drops([&] { parameters.refresh(); });
    return compare(before, parameters.rows());
  }

 private:
  Client& client_;
  const std::map<std::string, Value>& values_;
  microseconds reconnect_timeout_;
  int drops_ = 0;

  /// For work that may be done twice: begins again after each drop of the link.
  template <class Work>
  std::invoke_result_t<Work> through_drops(Work work) {
    while (true) {
      try {
        return work();
      } catch (const LinkLost&) {
        find_again();
      }
    }
  }

  void find_again() {
    constexpr int kDrops = 5;
    if (++drops_ > kDrops) fail_unknown("the link to " + client_.name() + " drops again and again");
    try {
      client_.reconnect(reconnect_timeout_);
    } catch (const LinkLost& lost) {
      fail_unknown(lost.what());
    }
  }

  [[noreturn]] static void fail_unknown(const std::string& why) {
    throw LinkLost(why + "; the robot holds the old set or the new one, whole: upload again once it answers",
                   ParameterProblem::set_unknown);
  }

  void change(RemoteParameters& parameters) {
    try {
      parameters.revert();
      for (const auto& [name, value] : values_) parameters.stage(name, value);
      parameters.commit();
    } catch (const LinkLost&) {
      find_again();
    } catch (const RobotRefused& refused) {
      // Opening the staging area again would take it from the session that has it now.
      if (refused.code() != protocol::ErrorCode::staging_lost) through_drops([&] { parameters.revert(); });
      throw;
    }
  }

  UploadReport compare(const std::vector<ParameterRow>& before,
                       const std::vector<ParameterRow>& after) const {
    UploadReport report;
    report.link_dropped = drops_ > 0;
    bool is_old = true, is_new = true;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto wanted = values_.find(before[i].name);
      const RawValue fresh = wanted == values_.end() ? before[i].active : to_raw(before[i], wanted->second);
      is_old = is_old && after[i].active == before[i].active;
      is_new = is_new && after[i].active == fresh;
      if (wanted == values_.end()) continue;
      report.values.push_back({before[i].name, before[i].unit, to_value(before[i], before[i].active),
                               to_value(before[i], fresh), to_value(before[i], after[i].active)});
    }
    if (!is_old && !is_new) {
      throw Error("the robot at " + client_.name() +
                      " holds neither the old nor the new parameters: another program may have changed them",
                  ParameterProblem::changed_by_another);
    }
    report.active = is_new ? ActiveSet::new_set : ActiveSet::old_set;
    return report;
  }
};

}  // namespace

Remark UploadReport::remark() const {
  const std::string held = active == ActiveSet::new_set
                               ? "the robot holds the new set, read back and compared"
                               : "the robot holds the old set, unchanged: upload again";
  if (!link_dropped) return {held, active};
  return {"the link dropped on the way; " + held, active, {"link_dropped"}};
}

UploadReport upload(Client& client, const std::map<std::string, Value>& values,
                    microseconds reconnect_timeout) {
  return Upload(client, values, reconnect_timeout).run();
}

void commit_at_rest(Client& client, RemoteParameters& parameters, const std::map<std::string, Value>& values,
                    const std::function<void()>& between, RetryPolicy patience) {
  between();
  // The robot would refuse the commit, after all values have been sent.
  if (protocol::gives_power(client.request(protocol::GetStatus{}, patience).mode))
    throw RobotRefused(protocol::CommitParameters::kName, protocol::ErrorCode::moving, 0);
  parameters.revert();
  for (const auto& [name, value] : values) {
    between();
    parameters.stage(name, value);
  }
  between();
  parameters.commit();
  for (const auto& [name, value] : values) {
    between();
    parameters.refresh(static_cast<std::size_t>(&parameters.row(name) - parameters.rows().data()));
  }
}

void require_read_back(const RemoteParameters& parameters, const std::map<std::string, Value>& values) {
  for (const auto& [name, value] : values) {
    const ParameterRow& row = parameters.row(name);
    if (row.active != to_raw(row, value))
      throw Error(row.name + " was read back as " + describe(row, to_value(row, row.active)));
  }
}

}  // namespace astro::robot
