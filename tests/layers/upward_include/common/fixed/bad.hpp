#pragma once
#include "host/base/error.hpp"
