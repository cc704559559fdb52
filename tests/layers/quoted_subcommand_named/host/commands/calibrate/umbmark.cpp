const char* const kHint = "'umbmark' has driven these";
