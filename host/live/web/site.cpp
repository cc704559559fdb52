#include "host/live/web/site.hpp"

#include <boost/beast/core/string.hpp>
#include <boost/beast/http/rfc7230.hpp>

namespace astro::web {

std::string_view RequestHead::field(std::string_view name) const {
  for (const auto& [each, value] : fields)
    if (boost::beast::iequals({each.data(), each.size()}, {name.data(), name.size()})) return value;
  return {};
}

bool RequestHead::offers(std::string_view subprotocol) const {
  const std::string_view offered = field("Sec-WebSocket-Protocol");
  boost::beast::http::token_list list({offered.data(), offered.size()});
  return list.exists({subprotocol.data(), subprotocol.size()});
}

Response sentence_response(int status, std::string_view sentence) {
  return {status, {{"Content-Type", "text/plain"}}, std::string(sentence) + '\n'};
}

}  // namespace astro::web
