#pragma once

const char* const kHint = "there is no file; press Enter once it is there";
const char* const kQuestion = "it is far from the end. Press Enter to keep it";
