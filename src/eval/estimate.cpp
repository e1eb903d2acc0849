// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/estimate.hpp"

namespace rhmap::eval {

Estimate keptInCloud(std::string name, std::vector<octomap::point3d> cloud) {
  return {.name = std::move(name), .keep = {}, .cloud = std::move(cloud)};
}

Estimate noRemoval() {
  return keptBy("no removal", [](const octomap::point3d&) { return true; });
}

Estimate oracle(const Labels& labels) {
  return {.name = "oracle",
          .keep =
              [labels](const LabelledScan& scan) {
                KeptMask mask(scan.labels.size());
                for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = labels.isDynamic(scan.labels[k]) ? 0 : 1;
                return mask;
              },
          .cloud = {}};
}

}  // namespace rhmap::eval
