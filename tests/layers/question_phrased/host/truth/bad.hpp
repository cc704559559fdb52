#pragma once

const char* const kHint = "nothing answers there: is the simulator running?";
