// SPDX-License-Identifier: BSD-3-Clause
#include "rhmap/eval/online_score.hpp"

#include <stdexcept>
#include <utility>

namespace rhmap::eval {

OnlineScore::OnlineScore(Labels labels, std::size_t lag) : labels_(std::move(labels)), lag_(lag) {
  if (lag == 0) throw std::invalid_argument("OnlineScore: the lag is 0 scans; at least 1 is wanted");
}

void OnlineScore::add(LabelledScan scan, const Estimate& now) {
  if (!now.keep) throw std::invalid_argument("OnlineScore: " + now.name + " is a cloud and cannot follow a map");
  judge(scan, now, at_once_);
  waiting_.push_back(std::move(scan));
  if (waiting_.size() <= lag_) return;
  judge(waiting_.front(), now, later_);
  waiting_.pop_front();
}

void OnlineScore::judge(const LabelledScan& scan, const Estimate& now, Counts& counts) const {
  const KeptMask mask = now.keep(scan);
  for (std::size_t k = 0; k < mask.size(); ++k) counts.add(labels_, scan.labels[k], mask[k] != 0);
}

}  // namespace rhmap::eval
