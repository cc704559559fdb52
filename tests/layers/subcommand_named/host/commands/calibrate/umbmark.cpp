// Its name is that of a subcommand. Here it may be named.
const char* const kHint = "run 'astrolabe umbmark' first";
