#pragma once

const char* const kHint = "run 'astrolabe umbmark' first";
