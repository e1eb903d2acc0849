// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/core/key_set.hpp"

namespace rhmap {

bool KeySet::operator==(const KeySet& other) const {
  const auto same_in_other = [&other](const Region& region) {
    const std::size_t i = other.findRegion(region.name);
    return region.octants == (i != kNowhere ? other.regions_[i].octants : Octants{});
  };
  return size_ == other.size_ && std::all_of(regions_.begin(), regions_.end(), same_in_other);
}

std::size_t KeySet::getOrCreateRegion(std::uint64_t name) {
  if (regions_.size() * 2 >= table_.size()) grow();
  std::uint32_t& number = table_[slotOf(name)];
  if (number == 0) {
    regions_.push_back({name});
    number = static_cast<std::uint32_t>(regions_.size());
  }
  return number - 1;
}

void KeySet::grow() {
  std::vector<std::uint32_t>(std::max<std::size_t>(table_.size() * 2, 16)).swap(table_);
  for (std::size_t i = 0; i < regions_.size(); ++i)
    table_[slotOf(regions_[i].name)] = static_cast<std::uint32_t>(i + 1);
}

}  // namespace rhmap
