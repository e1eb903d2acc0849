// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/io/cloud_reader.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "../test_files.hpp"
#include "rhmap/io/cloud_writer.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;
namespace {

const std::vector<octomap::point3d> kPoints{{1, 2, 3}, {-0.5f, 1e-7f, 1e9f}};

template <typename T>
std::string bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

struct CloudReader : testing::Test {
  std::vector<octomap::point3d> read(const std::string& name, const std::string& text) const {
    writeText(folder / name, text);
    return readCloud(folder / name);
  }

  void fails(const std::string& name, const std::string& text, const std::string& reason) const {
    expectMessage(messageOf([&] { read(name, text); }), {name, reason});
  }

  TempFolder folder;
};

TEST_F(CloudReader, ReadsWhatIsWrittenHere) {
  writePly(folder / "a.ply", kPoints);
  writePcd(folder / "a.PCD", kPoints);
  writePcd(folder / "empty.pcd", {});
  EXPECT_EQ(readCloud(folder / "a.ply"), kPoints);
  EXPECT_EQ(readCloud(folder / "a.PCD"), kPoints);
  EXPECT_TRUE(readCloud(folder / "empty.pcd").empty());
}

TEST_F(CloudReader, ReadsPcdWithFurtherFieldsInAnyOrder) {
  const std::string header =
      "VERSION 0.7\nFIELDS label z x hist y\nSIZE 2 4 4 4 8\nTYPE U F F F F\nCOUNT 1 1 1 2 1\nWIDTH 2\nHEIGHT 1\n"
      "VIEWPOINT 5 5 5 1 0 0 0\nPOINTS 2\nDATA ";
  EXPECT_EQ(read("a.pcd", header + "ascii\n252 3 1 7 7 2\n9 1e9 -0.5 7 7 1e-7\n"), kPoints);
  std::string body;
  for (const auto& point : kPoints)
    body += bytesOf<std::uint16_t>({252}) + bytesOf<float>({point.z(), point.x(), 7, 7}) + bytesOf<double>({point.y()});
  EXPECT_EQ(read("b.pcd", header + "binary\n" + body), kPoints);
}

TEST_F(CloudReader, ReadsPlyWithFurtherPropertiesAndElements) {
  const std::string vertex =
      "element vertex 2\nproperty uchar red\nproperty double x\nproperty float32 y\nproperty float z\n";
  EXPECT_EQ(read("a.ply", "ply\nformat ascii 1.0\ncomment x y z\n" + vertex +
                              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                              "8 1 2 3\n9 -0.5 1e-7 1e9\n3 0 1 0\n"),
            kPoints);
  std::string body;
  for (const auto& point : kPoints)
    body += bytesOf<char>({'r'}) + bytesOf<double>({point.x()}) + bytesOf<float>({point.y(), point.z()});
  EXPECT_EQ(read("b.ply", "ply\nformat binary_little_endian 1.0\n" + vertex + "end_header\n" + body + "rest"), kPoints);
}

TEST_F(CloudReader, ReadsLinesAndLeavesOutWhatIsNotFinite) {
  EXPECT_EQ(read("a.xyz", "# x y z\n1 2 3 252\n\nnan 0 0\n-0.5 1e-7 1e9\n"), kPoints);
  EXPECT_EQ(
      read("b.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 3\nDATA ascii\n1 2 3\nnan nan nan\n-0.5 1e-7 1e9\n"),
      kPoints);
}

TEST_F(CloudReader, SaysWhatIsWrong) {
  const std::string fields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  fails("a.las", "", "is no cloud; one of: .pcd, .ply");
  fails("a.pcd", "", "has no header that ends");
  fails("b.pcd", fields + "POINTS 2\nDATA binary_compressed\n",
        "binary_compressed cannot be read; one of: ascii, binary");
  fails("c.pcd", fields + "POINTS 999999999999\nDATA binary\nshort", "bytes are left");
  fails("d.pcd", fields + "POINTS 2\nDATA ascii\n1 2 3\n", "there are only 1");
  fails("e.pcd", fields + "DATA ascii\n1 2 3\n", "POINTS is missing");
  fails("f.pcd", "FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 0\nDATA ascii\n", "one x, one y and one z");
  fails("g.pcd", "FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 0\nDATA ascii\n", "SIZE");
  fails("h.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE I I I\nPOINTS 0\nDATA ascii\n", "not floats");
  fails("i.pcd", fields + "COUNT 1 1\nPOINTS 0\nDATA ascii\n", "COUNT lacks a value");
  fails("j.pcd", fields + "POINTS -1\nDATA ascii\n", "not a number: '-1'");
  fails("a.ply", "plyx\nend_header\n", "is no PLY file");
  fails("b.ply",
        "ply\nformat binary_big_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float "
        "z\nend_header\n",
        "binary_big_endian cannot be read");
  fails("c.ply", "ply\nformat ascii 1.0\nelement face 1\nend_header\n", "vertices do not come first");
  fails("d.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int x\nend_header\n", "not one number");
  fails("a.xyz", "1 2\n", "line 1: z of a point is missing");
}

}  // namespace
}  // namespace rhmap::io::test
