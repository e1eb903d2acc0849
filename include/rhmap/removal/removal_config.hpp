// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace rhmap {

/// R-GPE, region-wise ground plane estimation (Sec. III-C.1).
struct GroundConfig {
  bool enabled = true;
  double r_gro = 0.15;          ///< r_gro of Eq. (5): a cube this near to its region's plane is ground [m]
  double min_upright = 0.707;   ///< least z component of a ground plane's normal; 0.707 is a slope of 45 degrees
  double step = 0.4;
  int min_cubes = 6;            ///< fewer cubes make no plane
  int iterations = 3;           ///< plane fits, each to what the last one found to be ground
  double min_growth = 0.2;      ///< a region is fitted again when its cubes have grown by this share
  bool across_regions = true;   ///< a plane counts also for the cubes just above its region, and for unfitted neighbours
};

/// The scan as a range image I of m x n pixels.
struct RangeImageConfig {
  int rows = 0;              ///< m; 0: measured from the first scan
  int columns = 1024;        ///< n
  double fov_up = 0;         ///< elevation of the top row [deg]; with rows = 0 measured
  double fov_down = 0;       ///< elevation of the bottom row [deg]; with rows = 0 measured
};

/// How a candidate for removal is found: scan contexts and their ratios (Sec. III-C.2).
struct ContextConfig {
  double max_range = 80;      ///< cubes and points farther away are not judged [m]
  double delta_1 = 0.2;       ///< delta_1: a column of regions is a candidate below this ratio_1, Eq. (8)
  double delta_2 = 0.2;       ///< delta_2: a region is a candidate below this ratio_2, Eq. (13)
  double r_1 = 1.0;           ///< r_1 of Eq. (9): step of range to the pixel above that makes a point dented [m]
  double r_2 = 1.0;           ///< r_2 of Eq. (10): the same to the pixel below [m]
  double r_share = 0.02;      ///< r_1 and r_2 are at least this share of the range
  bool three_d = false;       ///< columns with a bulge-dented point are judged by ratio_2, region by region
  bool fov_clamp = true;      ///< the map's height counts only as far as the field of view reaches
  int min_points = 6;         ///< fewer points in a column are no evidence
  double min_height = 0.5;    ///< columns of the map that are lower are left alone [m]
};

/// Whether rays of a scan pass through a cube.
struct VisibilityConfig {
  bool enabled = true;   ///< remove only cubes that the scan sees through
  double margin = 0.2;   ///< what is seen has to be this much farther than the cube [m]
  double ball = 0.87, extra = 0, near = 0.5;
  int min_seen = 1; double segment = .2;
  int window = 1;        ///< pixels looked at on each side of the cube's own
};

/// Void: space that is known to be free for good. What is hit in it moves.
struct VoidConfig {
  bool enabled = true;
  double cell = 0.4;          ///< edge of a cell of free space [m]; rounded to 1, 2, 4 ... cubes
  double max_range = 50;      ///< rays are followed up to here [m]
  double surface = 0.2;       ///< d_s: this much of a ray's end is surface, not free [m]
  int tau_f = 6;              ///< scans in a row that must have crossed a cell and its 26 neighbours
  int tau_r = 20;             ///< scans in a row that must have hit a void cell to make it an ordinary one again
  int down = 0; int known = 3;
  int growth = 2;             ///< steps (cells) from what is hit in the void to what belongs to it
  double grown_ground = 0.07; ///< growth takes also ground cubes this much above their plane [m]; below 0: none
};

struct LookBack { bool enabled = true; int scans = 6, stride = 3, need = 2; double share = 0; int around = 3; double around_share = .6; int firm = 3; };
struct Verdict { double misses = 1, per_hit = 0, cap = 20, region_share = 0, octant_share = 0; };
struct SweepConfig {
  bool enabled = true;
  double max_range = 80;
  bool ground = true;
  Verdict ratio{1, 0, 20, 0, 0.8};
  Verdict other{3, 0, 20, 0, 0.8};
  Verdict late{1, 0, 20, 0, 0.8};
  Verdict sure{10, 0, 20, 0, 0.6};
  int around = 3;
  bool late_other = false;
  double hit_weight = 0;
};

/// The back end: keyframes that look at the map again when the sensor has moved on (Sec. III-D).
struct BackEndConfig {
  bool enabled = true;
  double distance = 2.0;       ///< a keyframe every so far [m]
  int scans = 10;              ///< and every so many scans
  double information = 5.0;    ///< and when V, Eq. (14), has changed by this [%]
  double delay = 20.0;         ///< a keyframe is used when the sensor is this far from it [m]
  int max_queue = 50;          ///< or when more keyframes than this wait
  int revert_hits = 20;        ///< cubes hit in this many scans have stopped, and stay; 0: no such guard
};

/// What becomes of a removed cube.
enum class RemovedCubes {
  kUnknown,  ///< forgotten, as in the paper
  kFree,     ///< free, where a ray is known to have passed through it; else forgotten
};

/// Everything that the removal of dynamic objects can be told; the defaults are the profile `default`.
struct RemovalConfig {
  int region_size = 8;        ///< cubes along a region's edge, m + 1: 4, 8 or 16
  double min_range = 2.7;     ///< nearer points are the carrier's own and left out [m]
  double max_range = -1;      ///< farther points are left out [m]; below 0: none are
  bool carve = false;         ///< mark what rays cross as free, too
  RemovedCubes removed = RemovedCubes::kUnknown;
  bool protect_hits = true;   ///< a scan removes no cube that it has hit itself
  bool shrink_heights = true; ///< H{max,min} of a column follows the removal of cubes
  GroundConfig ground;
  RangeImageConfig image;
  ContextConfig context;
  VisibilityConfig visibility;
  VoidConfig free_space;
  SweepConfig sweep;
  LookBack look_back;
  BackEndConfig back_end;
};

/// The paper's text, and where it is silent the choices of doc/removal.md.
RemovalConfig paperProfile();
/// 2D scan context, visibility of each cube, back end.
RemovalConfig fastProfile();
/// The best there is: fast, and the void.
RemovalConfig defaultProfile();

/// The names of the profiles: paper, fast, default.
std::span<const std::string_view> removalProfiles();
/// The profile of that name; std::invalid_argument that names the right ones.
RemovalConfig removalProfile(std::string_view name);

/// Throws std::invalid_argument that names the field and its value.
void validate(const RemovalConfig& config);

}  // namespace rhmap
