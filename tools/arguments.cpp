// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace rhmap::tools {
namespace {

/// The whole text as a number, or nothing.
template <class Number>
std::optional<Number> parseNumber(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A validator that answers a wrong value with `message(value)`.
template <class Accepts, class Message>
CLI::Validator makeValidator(Accepts accepts, Message message) {
  return CLI::Validator([=](std::string& text) { return accepts(text) ? std::string() : message(text); }, "");
}

bool isAbove0(const std::string& text) {
  const auto value = parseNumber<double>(text);
  return value && std::isfinite(*value) && *value > 0;
}

/// Why no file can be written under this name; empty if it can.
std::string folderProblem(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    return fmt::format("{}: there is no folder {}", path, folder.string());
  return std::filesystem::is_directory(path) ? path + " is a folder" : "";
}

}  // namespace

std::optional<FrameRange> parseFrames(const std::string& text) {
  const auto dash = text.find('-');
  const auto first = parseNumber<std::size_t>(std::string_view(text).substr(0, dash));
  const auto last =
      dash == std::string::npos ? first : parseNumber<std::size_t>(std::string_view(text).substr(dash + 1));
  if (!first || !last || *first > *last) return std::nullopt;
  return FrameRange{*first, *last};
}

FrameRange chooseFrames(const std::string& frames, const std::string& sequence, std::size_t num_scans) {
  if (num_scans == 0) throw std::runtime_error(sequence + ": no scans");
  if (frames.empty()) return {0, num_scans - 1};
  const FrameRange range = *parseFrames(frames);
  if (range.last >= num_scans)
    throw UsageError(fmt::format("--frames: {} is not in the sequence; it has 0-{}", frames, num_scans - 1));
  return range;
}

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

CLI::Validator outputFile(std::span<const std::string_view> extensions) {
  return CLI::Validator(
      [extensions](std::string& path) -> std::string {
        const std::string extension = extensionOf(path);
        if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
          return fmt::format("{} has no known extension; one of: {}", path, fmt::join(extensions, ", "));
        return folderProblem(path);
      },
      "");
}

CLI::Validator outputFileOrStdout() {
  return CLI::Validator([](std::string& path) { return path == "-" ? std::string() : folderProblem(path); }, "");
}

CLI::Validator lengthAbove0() {
  return makeValidator(isAbove0,
                       [](const std::string& text) { return text + " is not a length above 0; metres, e.g. 0.1"; });
}

CLI::Validator lengthFrom0() {
  return makeValidator(
      [](const std::string& text) {
        const auto value = parseNumber<double>(text);
        return value && std::isfinite(*value) && *value >= 0;
      },
      [](const std::string& text) { return text + " is not a length; metres, 0 or more, e.g. 2.7"; });
}

CLI::Validator countFrom1(std::string what) {
  return makeValidator(
      [](const std::string& text) {
        const auto value = parseNumber<int>(text);
        return value && *value >= 1;
      },
      [what = std::move(what)](const std::string& text) {
        return fmt::format("{} is not a number of {}; 1 or more", text, what);
      });
}

CLI::Validator countFrom0(std::string what) {
  return makeValidator([](const std::string& text) { return parseNumber<std::uint64_t>(text).has_value(); },
                       [what = std::move(what)](const std::string& text) {
                         return fmt::format("{} is not a {}; a whole number, 0 or more", text, what);
                       });
}

CLI::Validator rateAbove0() {
  return makeValidator(
      isAbove0, [](const std::string& text) { return text + " is not a rate above 0; times a second, e.g. 10"; });
}

CLI::Validator probability() {
  return makeValidator(
      [](const std::string& text) {
        const auto value = parseNumber<double>(text);
        return value && *value >= 0 && *value <= 1;
      },
      [](const std::string& text) { return text + " is not a probability; 0 to 1, e.g. 0.02"; });
}

CLI::Validator frameRange() {
  return makeValidator(
      [](const std::string& text) { return parseFrames(text).has_value(); },
      [](const std::string& text) { return text + " is not a range of frames; A-B with A not above B, e.g. 0-9"; });
}

CLI::Validator oneOf(std::string what, std::span<const std::string_view> words) {
  return makeValidator(
      [words](const std::string& text) { return std::find(words.begin(), words.end(), text) != words.end(); },
      [what = std::move(what), words](const std::string& text) {
        return fmt::format("{} is not a {}; one of: {}", text, what, fmt::join(words, ", "));
      });
}

void addResolution(CLI::App& verb, double& resolution, const std::string& what) {
  verb.add_option("--resolution", resolution, what)->type_name("M")->capture_default_str()->check(lengthAbove0());
}

void addMinRange(CLI::App& verb, double& min_range) {
  verb.add_option("--min-range", min_range, "Distance below which points are dropped")
      ->type_name("M")
      ->capture_default_str()
      ->check(lengthFrom0());
}

void addMaxRange(CLI::App& verb, std::optional<double>& max_range, const std::string& what) {
  verb.add_option("--max-range", max_range, what + " (default: none)")->type_name("M")->check(lengthAbove0());
}

void addFrames(CLI::App& verb, std::string& frames) {
  verb.add_option("--frames", frames, "Scans A to B, both included (default: all)")
      ->type_name("A-B")
      ->check(frameRange());
}

void addJson(CLI::App& verb, std::string& json, const std::string& what) {
  verb.add_option("--json", json, "Write " + what + " as JSON, - for stdout")
      ->type_name("FILE")
      ->check(outputFileOrStdout());
}

void requireExists(const std::string& path) {
  if (!std::filesystem::exists(path)) throw std::runtime_error(path + ": No such file");
}

}  // namespace rhmap::tools
