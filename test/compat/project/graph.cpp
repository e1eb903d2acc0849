// SPDX-License-Identifier: BSD-3-Clause
// What graph2tree does: a map of a scan graph with poses, plain, discretised and lazy.
#include <octomap/OcTree.h>
#include <octomap/Pointcloud.h>
#include <octomap/ScanGraph.h>

#include <cstdio>

#include "dice.hpp"
#include "parts.hpp"

void graph(const std::string& folder) {
  octomap::ScanGraph graph;
  Dice dice(3);
  for (int i = 0; i < 5; ++i) {
    const octomap::point3d sensor(dice.between(-3, 3), dice.between(-2, 2), 0);
    const octomap::pose6d pose(sensor.x(), sensor.y(), sensor.z(), 0, 0.1 * i, 0.3 * i);
    octomap::Pointcloud* scan = new octomap::Pointcloud(roomScan(sensor, 1500, dice));
    scan->transform(pose.inv());
    graph.addNode(scan, pose);
  }
  graph.connectPrevious();
  std::printf("%zu scans, %zu points\n", graph.size(), std::size_t(graph.getNumPoints()));
  graph.writeBinary(folder + "/scans.graph");
  octomap::ScanGraph read_back;
  read_back.readBinary(folder + "/scans.graph");

  octomap::OcTree scans(0.1), lazy(0.1), rays(0.2);
  for (octomap::ScanGraph::iterator it = read_back.begin(); it != read_back.end(); ++it) {
    const octomap::ScanNode& node = **it;
    scans.insertPointCloud(node, 8.0);
    lazy.insertPointCloud(*node.scan, octomap::point3d(0, 0, 0), node.pose, -1.0, true, true);
    octomap::Pointcloud in_map(*node.scan);
    in_map.transform(node.pose);
    rays.insertPointCloudRays(in_map, node.pose.trans());
    rays.insertRay(node.pose.trans(), octomap::point3d(5, 3, 1), 2.0);
  }
  scans.write(folder + "/scans.ot");
  lazy.write(folder + "/lazy_before.ot");
  lazy.updateInnerOccupancy();
  lazy.prune();
  lazy.write(folder + "/lazy.ot");
  rays.write(folder + "/rays.ot");
  scans.toMaxLikelihood();
  scans.prune();
  scans.writeBinaryConst(folder + "/scans.bt");
  std::printf("%zu, %zu and %zu nodes\n", scans.size(), lazy.size(), rays.size());

  octomap::KeySet free_cells, occupied_cells;
  octomap::Pointcloud in_map(*read_back.getNodeByID(2)->scan);
  in_map.transform(read_back.getNodeByID(2)->pose);
  rays.computeUpdate(in_map, read_back.getNodeByID(2)->pose.trans(), free_cells, occupied_cells, 6.0);
  octomap::point3d_list unknown;
  rays.getUnknownLeafCenters(unknown, octomap::point3d(-2, -2, -1), octomap::point3d(2, 2, 1));
  std::printf("%zu free, %zu occupied, %zu unknown\n", free_cells.size(), occupied_cells.size(), unknown.size());
}
