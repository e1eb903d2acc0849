// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "rhmap/io/scan_sequence.hpp"

namespace rhmap::tools {

/// Scans of a sequence of SemanticKITTI, by their numbers in the names of its files.
struct Window {
  std::string sequence;  ///< "00"
  FrameRange numbers;
};

/// Accepts "SEQUENCE:A-B".
CLI::Validator windowOfSequence();

/// What --windows says; the windows of the paper if it is empty.
std::vector<Window> windowsOf(const std::vector<std::string>& texts);

/// The windows of the paper, as --windows takes them.
std::string paperWindows();

/// A window as it is on disk, or why it is not.
struct FoundWindow {
  Window window;
  std::unique_ptr<io::ScanSequence> sequence;  ///< null if the window is not there
  FrameRange frames;                           ///< of the sequence: a part of a recording counts from 0
  std::string missing;                         ///< why
};

/// Looks for the sequence as ROOT/sequences/NN and ROOT/NN.
FoundWindow findWindow(const std::string& root, const Window& window);

}  // namespace rhmap::tools
