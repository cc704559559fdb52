#include "host/truth/good.hpp"

void Good::end() {}
