// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/labels.hpp"

#include <stdexcept>
#include <string>

namespace rhmap::eval {

Labels::Labels(std::span<const std::uint16_t> dynamic, std::span<const std::uint16_t> ignored)
    : kinds_(0x10000, Kind::kStatic) {
  for (const std::uint16_t label : ignored) kinds_[label] = Kind::kIgnored;
  for (const std::uint16_t label : dynamic) {
    if (kinds_[label] == Kind::kIgnored)
      throw std::invalid_argument("class " + std::to_string(label) + " cannot be dynamic and ignored");
    kinds_[label] = Kind::kDynamic;
  }
}

}  // namespace rhmap::eval
