#include "host/page/calls/attempt.hpp"

#include <exception>
#include <nlohmann/json.hpp>

namespace astro::page {

using nlohmann::json;

json refusal(const std::string& sentence, const std::vector<std::string>& values,
             const std::vector<std::string>& remedies) {
  return {{"error", {{"sentence", sentence}, {"values", values}, {"remedies", remedies}}}};
}

json attempt(const std::function<json()>& work,
             const std::function<std::vector<std::string>(const Error&)>& remedies) {
  try {
    return {{"result", work()}};
  } catch (const Error& error) {
    return refusal(error.what(), error.values(), remedies(error));
  } catch (const std::exception& error) {  // of a file, or of JSON
    return refusal(error.what());
  }
}

}  // namespace astro::page
