// SPDX-License-Identifier: BSD-3-Clause
// user FOLDER [compat]: a program that knows OctoMap alone. With `compat` it fails where octomap::OcTree is stock.
#include <octomap/octomap.h>

#include <cstdio>
#include <string>

#include "parts.hpp"

int main(int argc, char** argv) {
  if (argc < 2) return 2;
#ifndef RHMAP_COMPAT_OCTOMAP
  if (argc == 3) {
    std::puts("octomap::OcTree is OctoMap's own");
    return 1;
  }
#endif
  server(argv[1]);
  subclass(argv[1]);
  viewer(argv[1]);
  graph(argv[1]);
  ownNode(argv[1]);
  trees(argv[1]);
}
