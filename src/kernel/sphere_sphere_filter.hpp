// The decision of one pair in plain arithmetic, whose bounds are held against what proofs proves to suffice.
#pragma once

#include "contact/plain_cores.hpp"
#include "contact/plain_decision.hpp"
#include "kernel/proved_bounds.hpp"

namespace contact::kernel {

using plain_decision::filter;
using plain_decision::Filtered;
using plain_decision::squared_distance;

static_assert(plain_decision::Bounds<double>::kGap >= proved::kScalarGap);  // proofs, scalar_filter.g
static_assert(plain_decision::Bounds<double>::kFloor >= proved::kScalarFloor);
static_assert(plain_decision::Bounds<double>::kLeastRoom >= proved::kLeastRoom);
static_assert(plain_decision::CoreBounds::kGap >= proved::kCoreGap &&
              plain_decision::CoreBounds::kSignGap >= proved::kCoreSign &&
              plain_decision::CoreBounds::kHeightGap >= proved::kCoreHeight);

}  // namespace contact::kernel
