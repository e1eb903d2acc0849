// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "comparison.hpp"
#include "report_pictures.hpp"

namespace rhmap::tools {

/// The report as one HTML page that needs nothing else: neither files nor a network.
std::string reportPage(const Comparison& comparison, const ReportMaps& maps, std::span<const ReportPicture> pictures);

/// What to install for the page's 3D view; empty if it is there.
std::string missingViewer();

}  // namespace rhmap::tools
