#pragma once

/// A text of several lines, in the second of which the option stands.
const char* const kPage = R"(<p>No "ground truth" was recorded,
see --truth.</p>)";
