// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

// The parts of the program. Each prints what it finds and writes its maps into `folder`.
void graph(const std::string& folder);
void ownNode(const std::string& folder);
void server(const std::string& folder);
void subclass(const std::string& folder);
void trees(const std::string& folder);
void viewer(const std::string& folder);
