// Its name is that of a subcommand: `calibrate runs`. Here it may be named.
const char* const kHint = "'astrolabe calibrate runs' calibrates";
