// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <type_traits>

#include "rhmap/octree/byte_stream.hpp"
#include "rhmap/octree/node.hpp"
#include "rhmap/octree/structure.hpp"

/// The node data of .ot and .bt: what stands after the text header, and in messages. Both run over the nodes depth
/// first, children 0 ... 7. Upper levels go node by node, regions octet by octet.
namespace rhmap::codec {

/// Calls visit(i) for the nodes of an octet that are in `mask`.
template <class F>
void forEachBit(unsigned mask, F&& visit) {
  for (; mask != 0; mask &= mask - 1) visit(std::countr_zero(mask));
}

inline std::uint8_t maskOf(const Block& block, int octet) { return block.mask[static_cast<std::size_t>(octet)]; }

/// True if the children of a node are the top nodes of a region.
inline bool isAboveRegion(NodeRef at) { return at.block->level() == kRegionLevel - 1 && at.slot < kCells; }

[[noreturn]] inline void throwTooDeep() { throw std::runtime_error("a node at depth 16 claims to have children"); }

/// An editor for a region that is being read; what it made counts also where reading ends early.
template <class NODE>
class RegionReading {
 public:
  RegionReading(BlockStore<NODE>& store, NodeRef above)
      : store_(store), region_(*store.createBlockBelow(above)), editor_(store.editor()) {
    store_.touch(&region_);
  }
  ~RegionReading() { store_.takeOver(editor_); }
  RegionReading(const RegionReading&) = delete;
  RegionReading& operator=(const RegionReading&) = delete;

  NODE* create(int octet, unsigned bits) { return editor_.create(region_, octet, bits); }

 private:
  BlockStore<NODE>& store_;
  Block& region_;
  RegionEditor<NODE> editor_;
};

// --- .ot: value and child mask of every node ---

template <class CLASS, class R, class... ARGS>
CLASS declarerOf(R (CLASS::*)(ARGS...));
template <class CLASS, class R, class... ARGS>
CLASS declarerOf(R (CLASS::*)(ARGS...) const);

/// The class that says what a node's bytes are also says how they go into a stream. Otherwise it is a node class that
/// was written for OctoMap's interface and knows streams only.
template <class NODE>
inline constexpr bool kHasBytes =
    std::is_same_v<decltype(declarerOf(&NODE::toBytes)), decltype(declarerOf(&NODE::writeData))>;

/// Writes nodes with their child masks.
template <class NODE>
void writeNode(const NODE& node, std::uint8_t children, ByteWriter& out) {
  if constexpr (kHasBytes<NODE>) {
    char* to = out.begin(NODE::kDataBytes + 1);
    node.toBytes(to);
    to[NODE::kDataBytes] = static_cast<char>(children);
    out.end(to + NODE::kDataBytes + 1);
  } else {
    node.writeData(out.stream());
    out.put(children);
  }
}

/// Reads a node, and returns its child mask.
template <class NODE>
std::uint8_t readNode(NODE& node, ByteReader& in) {
  if constexpr (kHasBytes<NODE>) {
    const char* bytes = in.take(NODE::kDataBytes + 1);
    node.fromBytes(bytes);
    return static_cast<std::uint8_t>(bytes[NODE::kDataBytes]);
  } else {
    if (!node.readData(in.stream())) throw std::runtime_error("the data ends in the middle of a node");
    return static_cast<std::uint8_t>(*in.take(1));
  }
}

template <class NODE>
void writeRegionValues(const BlockStore<NODE>& store, const Block& region, ByteWriter& out) {
  const Octet<NODE> tops = store.octet(&region, kTopOctet);
  forEachBit(tops.mask, [&](int t) {
    const std::uint8_t middle_mask = maskOf(region, kMiddleOctet + t);
    writeNode(tops.nodes[t], middle_mask, out);
    if (middle_mask == 0) return;
    const NODE* middles = store.octet(&region, kMiddleOctet + t).nodes;
    forEachBit(middle_mask, [&](int i) {
      const std::uint8_t cell_mask = maskOf(region, 8 * t + i);
      writeNode(middles[i], cell_mask, out);
      if (cell_mask == 0) return;
      const NODE* cells = store.octet(&region, 8 * t + i).nodes;
      forEachBit(cell_mask, [&](int c) { writeNode(cells[c], 0, out); });
    });
  });
}

template <class NODE>
void writeValues(const BlockStore<NODE>& store, NodeRef at, ByteWriter& out) {
  const NodeRef o = store.childOctetOf(at);
  const std::uint8_t mask = o ? o.block->mask[o.slot] : std::uint8_t{0};
  writeNode(*store.node(at), mask, out);
  if (mask == 0) return;
  if (isAboveRegion(at)) return writeRegionValues(store, *o.block, out);
  forEachBit(mask, [&](int i) { writeValues(store, NodeRef{o.block, o.slot * 8 + i}, out); });
}

template <class NODE>
void readRegionValues(BlockStore<NODE>& store, NodeRef at, std::uint8_t mask, ByteReader& in) {
  RegionReading<NODE> region(store, at);
  NODE* tops = region.create(kTopOctet, mask);
  forEachBit(mask, [&](int t) {
    const std::uint8_t middle_mask = readNode(tops[t], in);
    if (middle_mask == 0) return;
    NODE* middles = region.create(kMiddleOctet + t, middle_mask);
    forEachBit(middle_mask, [&](int i) {
      const std::uint8_t cell_mask = readNode(middles[i], in);
      if (cell_mask == 0) return;
      NODE* cells = region.create(8 * t + i, cell_mask);
      forEachBit(cell_mask, [&](int c) {
        if (readNode(cells[c], in) != 0) throwTooDeep();
      });
    });
  });
}

template <class NODE>
void readValues(BlockStore<NODE>& store, NodeRef at, ByteReader& in) {
  const std::uint8_t mask = readNode(*store.node(at), in);
  if (mask == 0) return;
  if (isAboveRegion(at)) return readRegionValues(store, at, mask, in);
  const NodeRef o = store.createChildren(at, mask);
  forEachBit(mask, [&](int i) { readValues(store, NodeRef{o.block, o.slot * 8 + i}, in); });
}

// --- .bt: two bits for each child of every inner node ---
// 00 unknown, 01 free, 10 occupied, 11 has children (high bit first); child i stands at bit 2 i.

/// Bit 2 i for each bit i.
inline constexpr auto kEverySecondBit = [] {
  std::array<std::uint16_t, 256> spread{};
  for (unsigned bits = 0; bits < 256; ++bits)
    for (unsigned i = 0; i < 8; ++i)
      spread[bits] = static_cast<std::uint16_t>(spread[bits] | (bits >> i & 1) << (2 * i));
  return spread;
}();

/// The bits for an octet, of which those in `inner` have children.
template <class NODE, class Occupied>
unsigned bitsOf(const Octet<NODE>& octet, std::uint8_t inner, const Occupied& occupied) {
  unsigned high = 0;
  if constexpr (std::is_same_v<NODE, OcTreeNode>) {  // may look at what is not there, and do without branches
    for (unsigned i = 0; i < 8; ++i) high |= unsigned{occupied(octet.nodes[i])} << i;
    high &= octet.mask;
  } else {
    forEachBit(octet.mask, [&](int i) { high |= unsigned{occupied(octet.nodes[i])} << i; });
  }
  const unsigned low = (octet.mask & ~high) | inner;
  return kEverySecondBit[low] | unsigned{kEverySecondBit[high | inner]} << 1;
}

inline char* putBits(char* to, unsigned bits) {
  to[0] = static_cast<char>(bits);
  to[1] = static_cast<char>(bits >> 8);
  return to + 2;
}

inline unsigned takeBits(ByteReader& in) {
  const char* bytes = in.take(2);
  return static_cast<unsigned>(static_cast<std::uint8_t>(bytes[0])) |
         static_cast<unsigned>(static_cast<std::uint8_t>(bytes[1])) << 8;
}

/// Bit i of a mask for bit 2 i.
inline std::uint8_t everySecondBit(unsigned bits) {
  bits &= 0x5555;
  bits = (bits | bits >> 1) & 0x3333;
  bits = (bits | bits >> 2) & 0x0f0f;
  return static_cast<std::uint8_t>(bits | bits >> 4);
}

/// What the bits of an octet say.
struct ChildMasks {
  explicit ChildMasks(unsigned bits) : low(everySecondBit(bits)), high(everySecondBit(bits >> 1)) {}
  std::uint8_t low, high;
  std::uint8_t all() const { return low | high; }
  std::uint8_t inner() const { return low & high; }
  std::uint8_t occupied() const { return static_cast<std::uint8_t>(high & ~low); }
};

/// Gives the leaves among the children their values.
template <class NODE>
void setLeaves(NODE* nodes, const ChildMasks& children, float free, float occupied) {
  forEachBit(children.all() & ~unsigned{children.inner()},
             [&](int i) { nodes[i].setLogOdds(children.occupied() >> i & 1 ? occupied : free); });
}

/// Which of the eight masks from an octet on are not 0.
inline std::uint8_t existingOf(const Block& region, int first_octet) {
  std::uint64_t bytes = nonzeroBytes(masksFrom(region, first_octet)) >> 7;
  return static_cast<std::uint8_t>(bytes * 0x0102'0408'1020'4080 >> 56);
}

template <class NODE, class Occupied>
void writeRegionBits(const BlockStore<NODE>& store, const Block& region, const Occupied& occupied, ByteWriter& out) {
  char* to = out.begin(2 * kOctets);
  const std::uint8_t inner_tops = existingOf(region, kMiddleOctet);
  to = putBits(to, bitsOf(store.octet(&region, kTopOctet), inner_tops, occupied));
  forEachBit(inner_tops, [&](int t) {
    const std::uint8_t inner_middles = existingOf(region, 8 * t);
    to = putBits(to, bitsOf(store.octet(&region, kMiddleOctet + t), inner_middles, occupied));
    forEachBit(inner_middles, [&](int i) { to = putBits(to, bitsOf(store.octet(&region, 8 * t + i), 0, occupied)); });
  });
  out.end(to);
}

template <class NODE, class Occupied>
void writeBits(const BlockStore<NODE>& store, NodeRef at, const Occupied& occupied, ByteWriter& out) {
  const NodeRef o = store.childOctetOf(at);
  if (!o || o.block->mask[o.slot] == 0) {  // a root without children
    out.put(0);
    out.put(0);
    return;
  }
  if (isAboveRegion(at)) return writeRegionBits(store, *o.block, occupied, out);
  const Octet<NODE> children = store.octet(o.block, o.slot);
  unsigned inner = 0;
  forEachBit(children.mask, [&](int i) { inner |= unsigned{store.hasChildren({o.block, o.slot * 8 + i})} << i; });
  out.end(putBits(out.begin(2), bitsOf(children, static_cast<std::uint8_t>(inner), occupied)));
  forEachBit(inner, [&](int i) { writeBits(store, NodeRef{o.block, o.slot * 8 + i}, occupied, out); });
}

template <class NODE>
void readRegionBits(BlockStore<NODE>& store, NodeRef at, const ChildMasks& top, float free, float occupied,
                    ByteReader& in) {
  RegionReading<NODE> region(store, at);
  // An inner node without children is the same as a leaf; it gets the value of one that has none.
  const auto recompute = [](NODE& node, NODE* children, std::uint8_t mask) {
    structure::recompute(node, Octet<NODE>{children, mask});
  };
  NODE* tops = region.create(kTopOctet, top.all());
  setLeaves(tops, top, free, occupied);
  forEachBit(top.inner(), [&](int t) {
    const ChildMasks middle(takeBits(in));
    NODE* middles = middle.all() != 0 ? region.create(kMiddleOctet + t, middle.all()) : nullptr;
    setLeaves(middles, middle, free, occupied);
    forEachBit(middle.inner(), [&](int i) {
      const ChildMasks cell(takeBits(in));
      if (cell.inner() != 0) throwTooDeep();
      NODE* cells = cell.all() != 0 ? region.create(8 * t + i, cell.all()) : nullptr;
      setLeaves(cells, cell, free, occupied);
      recompute(middles[i], cells, cell.all());
    });
    recompute(tops[t], middles, middle.all());
  });
}

/// Free leaves get `free`, occupied ones `occupied`, inner nodes the maximum of their children, `at` itself nothing.
template <class NODE>
void readBits(BlockStore<NODE>& store, NodeRef at, float free, float occupied, ByteReader& in) {
  const ChildMasks children(takeBits(in));
  if (children.all() == 0) return;
  if (isAboveRegion(at)) return readRegionBits(store, at, children, free, occupied, in);
  if (at.depth() == kTreeDepth) throwTooDeep();
  const NodeRef o = store.createChildren(at, children.all());
  setLeaves(store.octet(o.block, o.slot).nodes, children, free, occupied);
  forEachBit(children.inner(), [&](int i) {
    const NodeRef child{o.block, o.slot * 8 + i};
    readBits(store, child, free, occupied, in);
    structure::recompute(store, child, store.children(child));
  });
}

}  // namespace rhmap::codec
