#pragma once
#include <fmt/format.h>

#include <Eigen/Core>
#include <vector>
