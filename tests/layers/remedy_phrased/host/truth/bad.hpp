#pragma once

const char* const kHint =
    "the times run backwards: "
    "record it again";
