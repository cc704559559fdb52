#pragma once

// Of these two only the second is wrong: astrolabe in a comment is no text.
const char* const kHint = "it was written by a newer astrolabe";
