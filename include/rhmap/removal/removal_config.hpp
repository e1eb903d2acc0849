// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace rhmap {

/// R-GPE, region-wise ground plane estimation (Sec. III-C.1).
struct GroundConfig {
  bool enabled = true;
  double r_gro = 0.15;         ///< r_gro of Eq. (5): a cube this near to its region's plane is ground [m]
  double min_upright = 0.707;  ///< least z component of a ground plane's normal; 0.707 is a slope of 45 degrees
  int min_cubes = 6;           ///< fewer cubes make no plane
  int iterations = 3;          ///< plane fits, each to what the last one found to be near
  double min_growth = 0.2;     ///< a region is fitted again when its cubes have grown by this share
  bool across_regions = true;  ///< planes count also for cubes just above their region and for unfitted neighbours
  double thin = 0.07;          ///< ground cubes this far above their plane go if they are seen through or belong to
                               ///< what moves [m]; below 0: none
  double depth = 0.2;          ///< what is farther below a plane is not its ground [m]; 0: everything below is
  double max_step = 0.4;       ///< a plane this far above that of a neighbour is no ground [m]; 0: any step is
  double around = 15;          ///< nor is one that, among the planes this far around [m] (0: none are looked at), is
  double raised = 0.8;         ///< above a third more than it is below, by more than this [m]
  double rise = 0.02;          ///< and this share of the distance
};

/// The scan as a range image I of m x n pixels.
struct RangeImageConfig {
  int rows = 0;         ///< m; 0: measured from the first scan with enough points
  int columns = 1024;   ///< n, or as many as a turn of the sensor has shots, if these are fewer
  double fov_up = 0;    ///< elevation of the top row [deg]; measured unless it is above fov_down
  double fov_down = 0;  ///< elevation of the bottom row [deg]
};

/// How candidates for removal are found: scan contexts and their ratios (Sec. III-C.2).
struct ContextConfig {
  double max_range = 80;    ///< what is farther away is not judged [m]
  double delta_1 = 0.2;     ///< delta_1: a column of regions is a candidate below this ratio_1, Eq. (8)
  double delta_2 = 0.2;     ///< delta_2: a region is a candidate below this ratio_2, Eq. (13)
  double r_1 = 1.0;         ///< r_1 of Eq. (9): step of range to a pixel above that makes a point dented [m]
  double r_2 = 1.0;         ///< r_2 of Eq. (10): the same to a pixel below [m]
  double r_share = 0.02;    ///< r_1 and r_2 are at least this share of the range
  bool three_d = false;     ///< columns with a bulge-dented point are judged by ratio_2, region by region
  bool max_ring = true;     ///< second case of Eq. (8), for columns with a point of the highest ring
  int min_points = 6;       ///< fewer points in a column are no evidence
  double min_height = 0.5;  ///< columns of the map that are lower are left alone [m]
};

/// Whether rays of a scan pass through a cube: what is seen in the cube's pixel lies behind it, what is seen in the
/// pixels around is not at its place, and one of these rays comes near enough.
struct VisibilityConfig {
  bool enabled = true;
  double behind = 0.2;         ///< behind the cube is what is this much farther [m]
  double before = 0.5;         ///< before it, what is this much nearer; in between something is at its place [m]
  double aside = 0.2;          ///< a ray tells of a cube if it passes this near to its middle [m]
  double aside_share = 0.005;  ///< or this near, as a share of the range
  double surface = 0.2;        ///< no cube is seen through that is this near to the line between two pixels' points [m]
  double surface_share = 0.007;  ///< or this near, as a share of the range: pixels are farther apart there
  double clearance = 2;          ///< such a line between columns is a wall's if it passes the sensor this far away [m]
  double skim = 1;               ///< what is near one within a column that passes the sensor nearer than this [m],
  double skim_from = 4;          ///< and this far from its nearer end [m], is skimmed: only looking back takes that
                                 ///< for seen through
  double edge_share = 0.15;      ///< above the first row's beam, behind is what is farther by this share
  double ball = 0.1;             ///< what a scan sees of a cube is the ball around it, up to this radius [m]
  int window = 1;                ///< pixels looked at on each side of the cube's own, more where the cube covers more
};

/// When a cube goes that scans have seen through.
struct EvidenceConfig {
  bool everywhere = true;     ///< all cubes in sight are looked at, not only those of candidates by ratio
  int interval = 4;           ///< each of these in one of so many scans,
  int doubtful_interval = 2;  ///< or so many, if scans have seen through cubes beside it;
  int ground_interval = 8;    ///< of the ground, only what is doubted and, in one of so many scans, the rest
  int misses = 2;             ///< looks in a row that must have seen through a cube; a candidate's goes at the first
  double share = 0.9;         ///< of the cubes around, doubted and firm ones, so many must be doubted
  double enough = 0.24;       ///< a single look will do if so much around is doubted and nothing is firm [m^2]
  int sure_misses = 12;       ///< after so many looks in a row,
  double sure_ratio = 3;      ///< and so many for each scan that has hit the cube,
  double sure_reach = 0.2;    ///< only what is so near to its octant is around it [m], taken as 1 to 4 cubes,
  double sure_share = 0.7;    ///< and a smaller share will do
  int firm = 3;               ///< scans that have hit a cube that speaks for those around it,
  int filled = 3;             ///< or so many looks must have seen something at its place; 1 to 7
};

/// What stands: where scans have hit something again and again over a long time, and rays have hardly crossed it, all
/// cubes of a cell of the void count as firm, however few scans have hit each.
struct StandingConfig {
  bool enabled = true;
  int scans = 5;         ///< so many scans must have hit the cell,
  int time = 15;         ///< its octant the first time so many scans ago,
  double crossed = 0.5;  ///< and rays have crossed it in at most so many scans for each of these; up to 100
};

/// Void: space that rays have crossed so often and so widely that what is hit in it moves.
struct VoidConfig {
  bool enabled = true;
  double cell = 0.4;       ///< edge of a cell of free space [m]; taken as 2 or 4 cubes
  double max_range = 70;   ///< rays are followed up to here [m]
  double surface = 0.2;    ///< d_s: this much of a ray's end is surface, not free [m]
  int interval = 3;        ///< the rays of one in so many scans are followed
  int tau_f = 2;           ///< so many of these scans must have crossed a cell since its last hit; 1 to 7
  double least_new = 0.2;  ///< cells not crossed on one side count, too, where so much that is hit is new [m^2]
  int tau_r = 7;           ///< so many of them in a row must have hit a void cell to make it an ordinary one again
  int growth = 2;          ///< steps (cells) from what is hit in the void to what belongs to it
  int known = 3;           ///< what moves takes no cube along that more scans than this have hit
};

/// Looking back: a cube that is new to the map holds something that has come if more past scans saw through it than saw
/// something at its place.
struct LookBackConfig {
  bool enabled = true;
  int scans = 5;        ///< past scans that are asked
  int stride = 12;      ///< scans from one of these to the next
  double share = 0.85;  ///< of the cubes around, new and firm ones, so many must be new in this way,
  double least = 0.04;  ///< and so much [m^2]
  int growth = 2;       ///< steps (cells of the void) from what has come to what belongs to it,
  double near = 30;     ///< up to here [m]; one step less of what is farther, where points are sparse
};

/// Leftovers: where most of what was there has gone, the few cubes of it go that no scan can tell of.
struct LeftoverConfig {
  bool enabled = true;
  double reach = 0.3;   ///< this far around the octant [m], taken as 1 to 4 cubes,
  double least = 0.06;  ///< so much must have gone [m^2],
  double share = 0.6;   ///< and such a share of that and what is there:
  double others = 0.2;  ///< firm cubes count as 1, others as this
  int interval = 16;    ///< looked for beside what goes at once, and everywhere in one of so many scans
};

/// The back end: keyframes that look at the map again when the sensor has moved on (Sec. III-D).
struct BackEndConfig {
  bool enabled = true;
  double distance = 2.0;     ///< a keyframe every so far [m]
  int scans = 10;            ///< and every so many scans
  double information = 5.0;  ///< and when V, Eq. (14), has changed by this [%]
  double delay = 20.0;       ///< a keyframe is used when the sensor is this far from it [m]
  int max_queue = 50;        ///< or when more keyframes than this wait
  int revert_hits = 20;      ///< cubes hit in this many scans have stopped, and stay; 0: no such guard
};

/// What becomes of a removed cube.
enum class RemovedCubes {
  kUnknown,  ///< forgotten, as in the paper
  kFree,     ///< free, where a ray is known to have passed through it; else forgotten
};

/// Everything that the removal of dynamic objects can be told; the defaults are the profile `default`.
struct RemovalConfig {
  int region_size = 8;     ///< cubes along a region's edge, m + 1: 4, 8 or 16
  double min_range = 2.7;  ///< nearer points are the carrier's own and left out [m]
  double max_range = -1;   ///< farther points are left out [m]; below 0: none are
  bool carve = false;      ///< cells that rays cross become free, except those that the removal takes for occupied
  RemovedCubes removed = RemovedCubes::kUnknown;
  bool protect_hits = true;    ///< a scan removes no cube that it has hit itself
  bool shrink_heights = true;  ///< H{max,min} of a column follows the removal of cubes
  GroundConfig ground;
  RangeImageConfig image;
  ContextConfig context;
  VisibilityConfig visibility;
  EvidenceConfig evidence;
  StandingConfig standing;
  VoidConfig free_space;
  LookBackConfig look_back;
  LeftoverConfig leftovers;
  BackEndConfig back_end;
};

/// The paper's text, and where it is silent the choices of doc/removal.md.
RemovalConfig paperProfile();
/// 2D scan context, visibility of each cube, back end.
RemovalConfig fastProfile();
/// The best there is: all cubes in sight are looked at, and what moves is kept out as it comes.
RemovalConfig defaultProfile();

/// The names of the profiles: paper, fast, default.
std::span<const std::string_view> removalProfiles();
/// The profile of that name; std::invalid_argument that names the right ones.
RemovalConfig removalProfile(std::string_view name);

/// Throws std::invalid_argument that names the field and its value.
void validate(const RemovalConfig& config);

}  // namespace rhmap
