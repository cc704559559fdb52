#pragma once

/// A bracket that is not closed hides nothing that follows: in [0, 1).
const char* const kHint = "give --runs";
