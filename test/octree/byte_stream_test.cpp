// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/octree/byte_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <sstream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#include "oracle.hpp"
#include "rhmap/octree/octree.hpp"

namespace rhmap {
namespace {

/// A stream that cannot be set back, as pipes and decompressors are.
class OneWay : public std::streambuf {
 public:
  explicit OneWay(std::string bytes) : bytes_(std::move(bytes)) {
    setg(bytes_.data(), bytes_.data(), bytes_.data() + bytes_.size());
  }

 private:
  std::string bytes_;
};

/// Trees of several sizes: empty, one cell, pruned, and larger than what is read ahead.
std::vector<std::unique_ptr<OcTree>> someTrees() {
  std::vector<std::unique_ptr<OcTree>> trees;
  for (const int edge : {0, 1, 8, 70}) {
    auto tree = std::make_unique<OcTree>(0.1);
    for (int x = 0; x < edge; ++x)
      for (int y = 0; y < edge; ++y)
        for (int z = 0; z < std::min(edge, 20); ++z)
          tree->updateNode(OcTreeKey(static_cast<key_type>(32700 + x), static_cast<key_type>(32760 + y),
                                     static_cast<key_type>(32767 + z)),
                           edge == 70 && (x * 31 + y * 17 + z * 7) % 5 == 0);
    trees.push_back(std::move(tree));
  }
  return trees;
}

template <class Write, class Read>
void checkOneAfterTheOther(std::istream& in, const std::vector<std::unique_ptr<OcTree>>& trees, Write&& write,
                           Read&& read) {
  for (const auto& tree : trees) {
    OcTree copy(0.1);
    if (tree->size() > 0) read(copy, in);
    ASSERT_TRUE(in.good());
    std::ostringstream again, expected;
    write(copy, again);
    write(*tree, expected);
    ASSERT_TRUE(again.str() == expected.str());
    ASSERT_EQ(in.get(), '|') << "what comes after a tree is not touched";
  }
  EXPECT_EQ(in.get(), std::char_traits<char>::eof());
}

TEST(ByteStream, ReadsNotAByteMoreThanTheTree) {
  const auto trees = someTrees();
  const auto check = [&](auto&& write, auto&& read) {
    std::ostringstream out;
    for (const auto& tree : trees) {
      write(*tree, out);
      out << '|';
    }
    std::istringstream in(out.str());
    checkOneAfterTheOther(in, trees, write, read);
    OneWay buffer(out.str());
    std::istream one_way(&buffer);
    checkOneAfterTheOther(one_way, trees, write, read);
  };
  check([](const OcTree& tree, std::ostream& s) { tree.writeData(s); },
        [](OcTree& tree, std::istream& s) { tree.readData(s); });
  check([](const OcTree& tree, std::ostream& s) { tree.writeBinaryData(s); },
        [](OcTree& tree, std::istream& s) { tree.readBinaryData(s); });
}

TEST(ByteStream, TakesPiecesAcrossTheEndsOfWhatItReadAhead) {
  std::string bytes;
  for (int i = 0; i < 300000; ++i) bytes.push_back(static_cast<char>(i % 251));
  std::istringstream in(bytes);
  {
    codec::ByteReader reader(in);
    std::size_t at = 0;
    for (std::size_t n = 1; at + n <= 250000; n = n % 37 + 1) {
      ASSERT_EQ(std::string(reader.take(n), n), bytes.substr(at, n));
      at += n;
    }
    bytes.erase(0, at);
  }
  EXPECT_TRUE(std::string(std::istreambuf_iterator<char>(in), {}) == bytes);
  codec::ByteReader empty(in);
  EXPECT_THROW(empty.take(1), std::runtime_error);
}

TEST(ByteStream, ATruncatedTreeGivesNoTree) {
  const auto trees = someTrees();
  std::ostringstream full, binary;
  trees.back()->writeData(full);
  trees.back()->writeBinaryData(binary);
  for (std::size_t cut = 1; cut < 40000; cut = cut * 3 / 2 + 1) {
    OcTree a(0.1), b(0.1);
    std::istringstream full_in(full.str().substr(0, full.str().size() - cut));
    EXPECT_TRUE(a.readData(full_in).fail());
    std::istringstream binary_in(binary.str().substr(0, binary.str().size() - std::min(cut, binary.str().size() - 1)));
    EXPECT_TRUE(b.readBinaryData(binary_in).fail());
    EXPECT_EQ(a.size() + b.size(), 0U);
  }
}

}  // namespace
}  // namespace rhmap
