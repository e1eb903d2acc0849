# SPDX-License-Identifier: BSD-3-Clause
# What rhmap is built on. OctoMap and Eigen are needed by everybody, the rest by the parts that name them.
include(GNUInstallDirs)
find_package(octomap REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(hwy REQUIRED)
include(rhmap-octomap)
