// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "rhmap/octree/structure.hpp"

/// The node data of .ot and .bt: what stands after the text header, and in messages. Both run over the nodes depth
/// first, children 0 ... 7.
namespace rhmap::codec {

/// Collects small pieces and hands them to the stream in large ones.
class ByteWriter {
 public:
  explicit ByteWriter(std::ostream& stream) : stream_(stream) {}
  ~ByteWriter() { flush(); }
  ByteWriter(const ByteWriter&) = delete;
  ByteWriter& operator=(const ByteWriter&) = delete;

  void put(std::uint8_t byte) { buffer_.push_back(static_cast<char>(byte)); }

  /// Room for `n` bytes, to be filled before the next call.
  char* extend(std::size_t n) {
    if (buffer_.size() >= kFlushAt) flush();
    buffer_.resize(buffer_.size() + n);
    return buffer_.data() + buffer_.size() - n;
  }

  /// The stream itself, for a piece that is written by others.
  std::ostream& stream() {
    flush();
    return stream_;
  }

 private:
  static constexpr std::size_t kFlushAt = 1 << 16;

  void flush() {
    stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  std::ostream& stream_;
  std::string buffer_;
};

/// Takes exactly N bytes; throws where the stream ends before.
template <std::size_t N>
std::array<char, N> take(std::istream& s) {
  std::array<char, N> bytes;
  if (s.rdbuf()->sgetn(bytes.data(), N) != static_cast<std::streamsize>(N))
    throw std::runtime_error("the data ends in the middle of the tree");
  return bytes;
}

/// Which of the children `mask` of `octet` have children.
template <class NODE>
std::uint8_t innerMask(const BlockStore<NODE>& store, NodeRef octet, std::uint8_t mask) {
  unsigned inner = 0;
  for (unsigned rest = mask; rest != 0; rest &= rest - 1) {
    const int i = std::countr_zero(rest);
    if (store.hasChildren({octet.block, octet.slot * 8 + i})) inner |= 1U << i;
  }
  return static_cast<std::uint8_t>(inner);
}

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

template <class NODE>
void writeNode(const NODE& node, ByteWriter& out) {
  if constexpr (kHasBytes<NODE>) {
    node.toBytes(out.extend(NODE::kDataBytes));
  } else {
    node.writeData(out.stream());
  }
}

/// Reads a node, and returns its child mask.
template <class NODE>
std::uint8_t readNode(NODE& node, std::istream& in) {
  if constexpr (kHasBytes<NODE>) {
    const auto bytes = take<NODE::kDataBytes + 1>(in);
    node.fromBytes(bytes.data());
    return static_cast<std::uint8_t>(bytes[NODE::kDataBytes]);
  } else {
    if (!node.readData(in)) throw std::runtime_error("the data ends in the middle of a node");
    return static_cast<std::uint8_t>(take<1>(in)[0]);
  }
}

template <class NODE>
void writeValues(const BlockStore<NODE>& store, NodeRef at, ByteWriter& out) {
  writeNode(*store.node(at), out);
  const NodeRef o = store.childOctetOf(at);
  const std::uint8_t mask = o ? o.block->mask[o.slot] : std::uint8_t{0};
  out.put(mask);
  for (unsigned rest = mask; rest != 0; rest &= rest - 1)
    writeValues(store, NodeRef{o.block, o.slot * 8 + std::countr_zero(rest)}, out);
}

template <class NODE>
void readValues(BlockStore<NODE>& store, NodeRef at, std::istream& in) {
  const std::uint8_t mask = readNode(*store.node(at), in);
  if (mask == 0) return;
  if (at.depth() == kTreeDepth) throw std::runtime_error("a node at depth 16 claims to have children");
  const NodeRef o = store.createChildren(at, mask);
  for (unsigned rest = mask; rest != 0; rest &= rest - 1)
    readValues(store, NodeRef{o.block, o.slot * 8 + std::countr_zero(rest)}, in);
}

// --- .bt: two bits for each child of every inner node ---

/// 00 unknown, 01 free, 10 occupied, 11 has children (high bit first); child i stands at bit 2 i.
template <class NODE, class Occupied>
void writeBits(const BlockStore<NODE>& store, NodeRef at, const Occupied& occupied, ByteWriter& out) {
  const NodeRef o = store.childOctetOf(at);
  if (!o || o.block->mask[o.slot] == 0) {  // a root without children
    out.put(0);
    out.put(0);
    return;
  }
  const Octet<NODE> children = store.octet(o.block, o.slot);
  const std::uint8_t inner = innerMask(store, o, children.mask);
  unsigned bits = 0;
  for (unsigned i = 0; i < 8; ++i)
    if (children.has(i)) bits |= (inner >> i & 1 ? 3U : occupied(children.nodes[i]) ? 2U : 1U) << (2 * i);
  out.put(static_cast<std::uint8_t>(bits));
  out.put(static_cast<std::uint8_t>(bits >> 8));
  for (unsigned rest = inner; rest != 0; rest &= rest - 1)
    writeBits(store, NodeRef{o.block, o.slot * 8 + std::countr_zero(rest)}, occupied, out);
}

/// Free leaves get `free`, occupied ones `occupied`, inner nodes the maximum of their children, `at` itself nothing.
template <class NODE>
void readBits(BlockStore<NODE>& store, NodeRef at, float free, float occupied, std::istream& in) {
  const auto bytes = take<2>(in);
  const unsigned bits = static_cast<std::uint8_t>(bytes[0]) | static_cast<unsigned>(static_cast<std::uint8_t>(bytes[1]))
                                                                  << 8;
  unsigned mask = 0;
  for (unsigned i = 0; i < 8; ++i) mask |= unsigned{(bits >> (2 * i) & 3) != 0} << i;
  if (mask == 0) return;
  if (at.depth() == kTreeDepth) throw std::runtime_error("a node at depth 16 claims to have children");
  const NodeRef o = store.createChildren(at, static_cast<std::uint8_t>(mask));
  for (unsigned i = 0; i < 8; ++i) {
    const unsigned pair = bits >> (2 * i) & 3;
    if (pair == 0) continue;
    const NodeRef child{o.block, o.slot * 8 + static_cast<int>(i)};
    if (pair == 3) {
      readBits(store, child, free, occupied, in);
      structure::recompute(store, child, store.children(child));
    } else {
      store.node(child)->setLogOdds(pair == 1 ? free : occupied);
    }
  }
}

}  // namespace rhmap::codec
