// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/Pointcloud.h>
#include <octomap/ScanGraph.h>
#include <octomap/octomap_types.h>

#include "OcTree.h"
