// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rhmap::tools {

/// The program was called wrongly; the message says what would be right.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Scans of a sequence, both ends included.
struct FrameRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// "A-B" or "A"; nothing when it is neither or runs backwards.
std::optional<FrameRange> parseFrames(const std::string& text);

/// The scans that --frames means, all if it is empty; UsageError for scans that the sequence does not have.
FrameRange chooseFrames(const std::string& frames, const std::string& sequence, std::size_t num_scans);

/// What follows the last dot of a file name, in lower case and with the dot.
std::string extensionOf(const std::string& path);

/// Accepts files with one of these extensions in a folder that exists, so that a long run is not lost at its end.
CLI::Validator outputFile(std::span<const std::string_view> extensions);

/// Accepts any file in a folder that exists, and "-".
CLI::Validator outputFileOrStdout();

/// Accepts a length [m]: above 0, or from 0 on.
CLI::Validator lengthAbove0();
CLI::Validator lengthFrom0();

/// Accepts a number of times a second above 0.
CLI::Validator rateAbove0();

/// Accepts a number from 0 to 1.
CLI::Validator probability();

/// Accepts a whole number from 1 on, or from 0 on; `what` is the noun for a wrong one.
CLI::Validator countFrom1(std::string what);
CLI::Validator countFrom0(std::string what);

/// Accepts "A-B" and "A".
CLI::Validator frameRange();

/// Accepts one of these words; `what` is the noun for a wrong one.
CLI::Validator oneOf(std::string what, std::span<const std::string_view> words);

/// Options of the verbs that read a sequence: the edge of a cube; points nearer than this [m] are dropped; what happens
/// beyond a distance, none unless told; the scans for chooseFrames().
void addResolution(CLI::App& verb, double& resolution, const std::string& what);
void addMinRange(CLI::App& verb, double& min_range);
void addMaxRange(CLI::App& verb, std::optional<double>& max_range, const std::string& what);
void addFrames(CLI::App& verb, std::string& frames);

/// A file for `what` as JSON.
void addJson(CLI::App& verb, std::string& json, const std::string& what);

/// Throws "FILE: No such file" when there is none.
void requireExists(const std::string& path);

}  // namespace rhmap::tools
