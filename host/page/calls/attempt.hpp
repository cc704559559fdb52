#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/base/error.hpp"

/// The answers of all calls: {"result": ...}, or {"error": {"sentence": ..., "values": [...], "remedies": [...]}}.
namespace astro::page {

nlohmann::json refusal(const std::string& sentence, const std::vector<std::string>& values = {},
                       const std::vector<std::string>& remedies = {});

/// What `work` returns as the result, or the error that it throws; `remedies` says what can be stated against one.
nlohmann::json attempt(const std::function<nlohmann::json()>& work,
                       const std::function<std::vector<std::string>(const Error&)>& remedies);

}  // namespace astro::page
