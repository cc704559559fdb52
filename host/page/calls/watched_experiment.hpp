#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/experiment/drive/record_run.hpp"
#include "host/experiment/files/plan.hpp"
#include "host/page/calls/calls.hpp"
#include "host/robot/client/client.hpp"
#include "host/simulation/robot/virtual_robot.hpp"

namespace astro::page {

/// The experiment that a question asks for: "runs", squares in each direction and phase, and "side_m". Throws astro::Error for sizes
/// that cannot be driven.
experiment::Plan plan_in(const nlohmann::json& question);

/// A whole experiment with a simulated robot, as a page watches it.
///
/// `name`    of the folder of its recordings, which replaces an earlier one.
/// events    those of try_out (try_out.hpp)
/// answer    {"results": what `umbmark --json` prints, "verdict": a paragraph, "report": the file of the report}
/// `run`     whom a drive asks and tells; its `moved` is not called.
///
/// Throws what run_experiment throws; Interrupted once `run.interrupted` answers true.
nlohmann::json watched_experiment(robot::Client& client,
                                  const std::shared_ptr<simulation::VirtualRobot>& robot,
                                  const experiment::Plan& plan, const std::filesystem::path& folder,
                                  const std::string& name, const Emit& emit,
                                  const experiment::RunHooks& run = {});

}  // namespace astro::page
