// Compiled once for all tests. Each test still includes what it needs: this saves time, and is no header to rely on.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "brickfall/brickfall.h"
