#pragma once

const char* const kHint = "give --verbose";
