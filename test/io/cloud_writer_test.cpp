// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/io/cloud_writer.hpp"

#include <gtest/gtest.h>
#include <octomap/Pointcloud.h>

#include <vector>

#include "../test_files.hpp"

namespace rhmap::io::test {
using namespace rhmap::test;
namespace {

const std::vector<octomap::point3d> kPoints = {{1, 2, 3}, {-0.5f, 1e-7f, 1e9f}};

std::string bytesOf(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

TEST(CloudWriter, WritesBinaryPly) {
  const TempFolder folder;
  writePly(folder / "a.ply", kPoints);
  EXPECT_EQ(readText(folder / "a.ply"),
            "ply\nformat binary_little_endian 1.0\nelement vertex 2\n"
            "property float x\nproperty float y\nproperty float z\nend_header\n" +
                bytesOf({1, 2, 3, -0.5f, 1e-7f, 1e9f}));
}

TEST(CloudWriter, WritesBinaryPcd) {
  const TempFolder folder;
  writePcd(folder / "a.pcd", kPoints);
  EXPECT_EQ(readText(folder / "a.pcd"),
            "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
            "COUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA binary\n" +
                bytesOf({1, 2, 3, -0.5f, 1e-7f, 1e9f}));
}

TEST(CloudWriter, TakesOctomapsPointcloudAndAnEmptyList) {
  const TempFolder folder;
  octomap::Pointcloud cloud;
  for (const octomap::point3d& point : kPoints) cloud.push_back(point);
  writePly(folder / "cloud.ply", cloud);
  writePly(folder / "list.ply", kPoints);
  EXPECT_EQ(readText(folder / "cloud.ply"), readText(folder / "list.ply"));
  writePcd(folder / "empty.pcd", {});
  EXPECT_NE(readText(folder / "empty.pcd").find("POINTS 0\nDATA binary\n"), std::string::npos);
}

TEST(CloudWriter, AFileThatCannotBeMadeIsAnError) {
  const TempFolder folder;
  expectMessage(messageOf([&] { writePly(folder / "none/a.ply", kPoints); }), {"none/a.ply", "cannot be created"});
  expectMessage(messageOf([&] { writePcd(folder / "none/a.pcd", kPoints); }), {"none/a.pcd", "cannot be created"});
}

}  // namespace
}  // namespace rhmap::io::test
