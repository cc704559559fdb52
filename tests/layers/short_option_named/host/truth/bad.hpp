#pragma once

const char* const kHint = "the port can be named with -p PORT";
