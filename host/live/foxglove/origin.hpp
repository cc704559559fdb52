#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/live/web/origin.hpp"

namespace astro::foxglove {

using web::is_origin;
using web::origin_can_be_proposed;
using web::OriginProblem;

/// Whether a connection may come from this web page. A browser names the page's origin ("https://app.foxglove.dev") in each
/// WebSocket handshake, and a page cannot change it; so this keeps any page that somebody happens to look at from reading or
/// driving the robot, also if that page's host name leads to this computer (DNS rebinding).
///
/// Accepted  no origin (a program that is no browser); Foxglove's pages over https; pages of this computer (localhost,
///           127.0.0.1, ::1); and those in `allowed`, each as a browser writes it: scheme://host[:port].
/// Refused   all others, also "null", which pages from files and from sandboxes share.
bool origin_is_allowed(std::string_view origin, std::span<const std::string> allowed);

}  // namespace astro::foxglove
