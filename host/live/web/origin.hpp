#pragma once

#include <string_view>

/// Where a request comes from, as a browser says it. A page cannot change its origin, so this keeps any page that somebody happens
/// to look at away from a robot.
namespace astro::web {

/// Values: the origin of the page.
enum class OriginProblem { refused };

/// Whether it is a page that a server of this computer serves: localhost, 127.0.0.1 or ::1, at any port.
bool is_this_computer(std::string_view origin);

/// Whether the page is one of the server that it talks to, which it calls `host` (the header Host).
bool is_same_origin(std::string_view origin, std::string_view host);

/// Whether a request that calls the server `host` (the header Host) can be meant for it. A name that leads here may be
/// anybody's (DNS rebinding), so only localhost and addresses are accepted, at any port: a tunnel may have another one.
bool host_is_ours(std::string_view host);

/// Whether a page's origin may be shown to a person as something to allow: it is written as a browser writes it, in letters,
/// digits and .:/_[]- alone, so that a stranger cannot have anything else pasted into a shell. "null" may not: all pages in
/// sandboxes have it.
bool origin_can_be_proposed(std::string_view origin);

/// Whether the text has the form of an origin that a browser names: scheme://host[:port], without a path; or "null".
bool is_origin(std::string_view origin);

}  // namespace astro::web
