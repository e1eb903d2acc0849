// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

namespace rhmap::eval {

/// Throws std::invalid_argument, which names the field, unless it is a length above 0 (or from 0 on).
inline void requireLength(double length, const std::string& field, bool may_be_0 = false) {
  if (!std::isfinite(length) || length < 0 || (length == 0 && !may_be_0))
    throw std::invalid_argument(field + " is " + std::to_string(length) + "; a length in metres is wanted");
}

}  // namespace rhmap::eval
