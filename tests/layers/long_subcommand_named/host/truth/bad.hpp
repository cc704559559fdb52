#pragma once

const char* const kHint =
    "it was found by calibrate "
    "runs, not by hand";
