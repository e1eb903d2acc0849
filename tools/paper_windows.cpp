// SPDX-License-Identifier: BSD-3-Clause
#include "paper_windows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <optional>

#include "paper_figures.hpp"

namespace rhmap::tools {
namespace {

std::optional<Window> parseWindow(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  const auto numbers = parseFrames(text.substr(colon + 1));
  if (!numbers) return std::nullopt;
  return Window{text.substr(0, colon), *numbers};
}

/// The place of scan `number` in the sequence, by its name.
std::optional<std::size_t> indexOf(const io::ScanSequence& sequence, std::size_t number) {
  const std::string name = fmt::format("{:06}", number);
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    if (sequence.name(i) == name) return i;
  }
  return std::nullopt;
}

}  // namespace

std::string paperWindows() {
  std::vector<std::string> texts;
  for (const Window& window : windowsOf({}))
    texts.push_back(fmt::format("{}:{}-{}", window.sequence, window.numbers.first, window.numbers.last));
  return fmt::format("{}", fmt::join(texts, ","));
}

CLI::Validator windowOfSequence() {
  return CLI::Validator(
      [](std::string& text) {
        return parseWindow(text) ? std::string()
                                 : text + " is not a window; SEQUENCE:A-B with A not above B, e.g. 05:2350-2670";
      },
      "");
}

std::vector<Window> windowsOf(const std::vector<std::string>& texts) {
  std::vector<Window> windows;
  for (const std::string& text : texts) windows.push_back(*parseWindow(text));
  if (!windows.empty()) return windows;
  for (const PublishedWindow& published : kPublished)
    windows.push_back({std::string(published.sequence), {published.first, published.last}});
  return windows;
}

FoundWindow findWindow(const std::string& root, const Window& window) {
  FoundWindow found{.window = window, .sequence = nullptr, .frames = {}, .missing = {}};
  const std::filesystem::path base = root;
  std::filesystem::path folder = base / "sequences" / window.sequence;
  if (!std::filesystem::is_directory(folder)) folder = base / window.sequence;
  if (!std::filesystem::is_directory(folder)) {
    found.missing = "no such folder";
    return found;
  }
  std::unique_ptr<io::ScanSequence> sequence;
  try {
    sequence = io::openSequence(folder);
  } catch (const std::runtime_error& reason) {  // e.g. labels without scans: the other sequences may be whole
    found.missing = "cannot be read: " + std::string(reason.what());
    return found;
  }
  const auto [from, to] = window.numbers;
  const auto first = indexOf(*sequence, from), last = indexOf(*sequence, to);
  if (!first || !last || *last - *first != to - from) {
    found.missing = fmt::format("has scans {} to {}, not all of {}-{}", sequence->name(0),
                                sequence->name(sequence->size() - 1), from, to);
  } else if (!sequence->hasLabels()) {
    found.missing = "has no labels";
  } else {
    found.frames = {*first, *last};
    found.sequence = std::move(sequence);
  }
  return found;
}

}  // namespace rhmap::tools
