#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

/// What a page can ask for, by name, with JSON in and out: the same for the module in the browser and for a program that
/// serves the page. What is computed is that of the libraries; here it is put into words of JSON only.
namespace astro::page {

/// Receives what happens while a call is under way: {"event": "run", ...}.
using Emit = std::function<void(const nlohmann::json&)>;

/// Answers {"result": ...} or, if the call cannot be done, {"error": {"sentence": ..., "values": [...], "remedies": names of
/// what can be stated against it (remedies.hpp)}}. Throws nothing but what `emit` throws that is no std::exception.
///
/// `folder`  where files are read and written; paths in questions and answers are relative to it.
nlohmann::json answer(const std::string& call, const nlohmann::json& question,
                      const std::filesystem::path& folder, const Emit& emit);

/// An answer or an event as text. Files may hold bytes that are no UTF-8, and some stand in the sentences about them: each such
/// byte becomes U+FFFD.
std::string json_text(const nlohmann::json& answer);

}  // namespace astro::page
