#pragma once

const char* const kHint = "the slip is above --K";
