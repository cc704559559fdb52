#pragma once

#include <span>
#include <string>
#include <string_view>

namespace astro::foxglove {

/// Values: the origin of the page.
enum class OriginProblem { refused };

/// Whether a connection may come from this web page. A browser names the page's origin ("https://app.foxglove.dev") in each
/// WebSocket handshake, and a page cannot change it; so this keeps any page that somebody happens to look at from reading or
/// driving the robot, also if that page's host name leads to this computer (DNS rebinding).
///
/// Accepted  no origin (a program that is no browser); Foxglove's pages over https; pages of this computer (localhost,
///           127.0.0.1, ::1); and those in `allowed`, each as a browser writes it: scheme://host[:port].
/// Refused   all others, also "null", which pages from files and from sandboxes share.
bool origin_is_allowed(std::string_view origin, std::span<const std::string> allowed);

/// Whether a page's origin may be shown to a person as something to allow: it is written as a browser writes it, in letters,
/// digits and .:/_[]- alone, so that a stranger cannot have anything else pasted into a shell. "null" may not: all pages in
/// sandboxes have it.
bool origin_can_be_proposed(std::string_view origin);

/// Whether the text has the form of an origin that a browser names: scheme://host[:port], without a path; or "null".
bool is_origin(std::string_view origin);

}  // namespace astro::foxglove
