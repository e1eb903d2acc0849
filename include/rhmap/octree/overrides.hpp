// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <typeinfo>

namespace rhmap {

/// Tells which virtual members of a base class the class of an object overrides. It decides between a fast way that has
/// OctoMap's rules built in and the way that asks the class at each step; the answer "all" is always safe.
///
/// There is no portable question for this. The Itanium ABI (GCC, Clang) says where to look: a virtual member's address
/// is an offset into the table that the object's first word points to.
class VirtualTable {
 public:
  /// To be called in the base class' constructor: the table of the base class itself. Later: of the class that the
  /// object turned out to be.
  template <class BASE>
  explicit VirtualTable(const BASE& object) {
    static_assert(std::is_polymorphic_v<BASE>);
    std::memcpy(&table_, static_cast<const void*>(&object), sizeof table_);
  }

  /// True if the two tables agree on a member (`&Base::f`).
  template <class MEMBER>
  bool agrees([[maybe_unused]] const VirtualTable& other, [[maybe_unused]] MEMBER member) const {
    static_assert(std::is_member_function_pointer_v<MEMBER>);
#if defined(__GXX_ABI_VERSION)
    struct Address {
      std::ptrdiff_t place;  // virtual members: 1 + offset in bytes (on ARM without the 1)
      std::ptrdiff_t adjustment;
    } address;
    static_assert(sizeof address == sizeof member);
    std::memcpy(&address, &member, sizeof address);
#if defined(__aarch64__) || defined(__arm__)
    const std::ptrdiff_t offset = address.place;
#else
    const std::ptrdiff_t offset = address.place - 1;
#endif
    return std::memcmp(table_ + offset, other.table_ + offset, sizeof(void*)) == 0;
#else
    return false;
#endif
  }

 private:
  const char* table_;
};

/// Remembers an answer that depends on nothing but the class of an object. An object under construction changes its
/// class on the way; hence the comparison.
class PerClass {
 public:
  template <class OBJECT, class F>
  bool operator()(const OBJECT& object, F&& answer) {
    if (const std::type_info* type = &typeid(object); type != type_) {
      answer_ = answer();
      type_ = type;
    }
    return answer_;
  }

 private:
  const std::type_info* type_ = nullptr;
  bool answer_ = false;
};

}  // namespace rhmap
